// SPDX-License-Identifier: Apache-2.0
// Made from msq.h by bindings/make_bindings.py: change those.
using System;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace Msq
{
    /// <summary>Values of msq_status.</summary>
    public enum StatusCode
    {
        Ok = 0,
        /// <summary>An argument is NULL, not finite, out of range, or inconsistent with another.</summary>
        Argument = -1,
        /// <summary>An allocation failed.</summary>
        Memory = -2,
        /// <summary>The job was cancelled.</summary>
        Cancelled = -3,
        /// <summary>A host callback failed, see msq_error_host_code(), or returned an invalid value (host code 0).</summary>
        Host = -4,
        /// <summary>A file cannot be opened or read, is truncated, or is malformed.</summary>
        Io = -5,
        /// <summary>This build lacks the feature, or msq does not read the file format.</summary>
        Unsupported = -6,
        /// <summary>Malformed mesh arrays. Dirty meshes are not an error.</summary>
        Mesh = -7,
        /// <summary>A documented limit would be exceeded, for example the memory limit of the context.</summary>
        Limit = -8,
        /// <summary>A defect in msq. Please report it.</summary>
        Internal = -9,
    }

    /// <summary>Which cached cells are evicted first. Cells in use are never evicted.</summary>
    public enum CachePolicy
    {
        /// <summary>The oldest cell first. Best for slicing from one end to the other.</summary>
        Fifo = 0,
        /// <summary>Cells that were used only once first (S3-FIFO). Best if frames or sets use the same cells again and not all of these cells fit.</summary>
        Segmented = 1,
    }

    /// <summary>What a warning is about.</summary>
    public enum WarningCode
    {
        /// <summary>A mesh is not closed. MSQ_WINDING_AUTO decides membership by its generalised winding number. Once per shape, by the function that creates it.</summary>
        OpenMesh = 1,
        /// <summary>The smallest cells of a structure are less than 4 pixels wide or 4 layers high. Once per slicer, by msq_slicer_create.</summary>
        CoarsePitch = 2,
        /// <summary>Cells were built for one use, because the cache had no room for them. Once per context, by a set query, msq_slicer_run, msq_slice_layer, msq_printability, msq_ray_cast or msq_render. Not given with cache_bytes = 0.</summary>
        SmallCache = 3,
        /// <summary>Unit cells of a lattice have nodes on their faces that the next cell, or another one of the library, does not have. Once per structure, by msq_structure_lattice. msq_unit_cell_info and msq_lattice_faces locate them.</summary>
        UnmatchedCells = 4,
    }

    /// <summary>Winding numbers that are inside a mesh.</summary>
    public enum Winding
    {
        /// <summary>All except 0. Overlapping and inverted parts are solid.</summary>
        Nonzero = 0,
        EvenOdd = 1,
        /// <summary>Only parts whose normals point outwards are solid.</summary>
        Positive = 2,
        /// <summary>Default. Closed meshes: NONZERO. Other meshes: NONZERO of the generalised winding number, rounded half up to a whole number.</summary>
        Auto = 3,
    }

    /// <summary>Type of the numbers in a host's array. Coordinates in model units are MSQ_FLOAT32 or MSQ_FLOAT64. Images take all types except MSQ_INT32 and MSQ_INT64. Polygons to fill (msq_fill_def) take MSQ_INT32 and MSQ_INT64. Contours take these two and MSQ_FLOAT64.</summary>
    public enum NumberType
    {
        Float32 = 1,
        Float64 = 2,
        Uint8 = 3,
        Int16 = 4,
        Uint16 = 5,
        Int32 = 6,
        Int64 = 7,
    }

    /// <summary>Mesh file formats that msq reads.</summary>
    public enum Format
    {
        /// <summary>By the extension of the file.</summary>
        Auto = 0,
        /// <summary>Binary or ASCII.</summary>
        Stl = 1,
        Obj = 2,
        Ply = 3,
        Off = 4,
        Format3mf = 5,
        Amf = 6,
        /// <summary>glTF 2.0, text or binary (GLB).</summary>
        Gltf = 7,
    }

    /// <summary>Maps from space to warped cells.</summary>
    public enum WarpKind
    {
        /// <summary>Cells around the z axis of the grid.</summary>
        Cylindrical = 1,
        /// <summary>Cells around the origin of the grid.</summary>
        Spherical = 2,
        /// <summary>Cells placed by a map that the host samples.</summary>
        Sampled = 3,
    }

    /// <summary>Which side of an image's threshold is solid. The threshold itself is solid.</summary>
    public enum SolidSide
    {
        Above = 0,
        Below = 1,
    }

    /// <summary>Boolean operations on shapes and on structures.</summary>
    public enum BooleanOperation
    {
        /// <summary>Points in any of them.</summary>
        Union = 1,
        /// <summary>Points in all of them.</summary>
        Intersection = 2,
        /// <summary>Points of the first that are in no other. The boundary of what is subtracted is outside.</summary>
        Difference = 3,
    }

    /// <summary>Unit cells of strut lattices. Nodes and struts are in the unit cube; the number of struts is that of one cell.</summary>
    public enum UnitCell
    {
        /// <summary>Nodes and struts of the definition.</summary>
        Custom = 0,
        /// <summary>Edges of the cube: 3 struts.</summary>
        Cubic = 1,
        /// <summary>Centre to the 8 corners.</summary>
        Bcc = 2,
        /// <summary>Corners to face centres, and the octahedron of the face centres: 24 struts.</summary>
        Octet = 3,
        /// <summary>Diagonals of the faces: 12 struts.</summary>
        Fcc = 4,
        /// <summary>Edges of space-filling truncated octahedra: 24 struts.</summary>
        Kelvin = 5,
        /// <summary>Bonds of the diamond crystal: 16 struts.</summary>
        Diamond = 6,
        /// <summary>Edges of space-filling rhombic dodecahedra: 32 struts.</summary>
        RhombicDodecahedron = 7,
        /// <summary>Auxetic: widens in x and y when pulled along z. Uprights along z, 3/4 of the cell high, every second one half a cell higher, and slanted struts between the ends of neighbours: 22 struts.</summary>
        Reentrant = 8,
    }

    /// <summary>Unit cells of plate lattices: triangles in the unit cube, in the order of face_factors.</summary>
    public enum PlateCell
    {
        /// <summary>Nodes and faces of the definition.</summary>
        Custom = 0,
        /// <summary>Simple cubic: planes {100}, the faces of the cube, 2 triangles each normal to x, y and z.</summary>
        Cubic = 1,
        /// <summary>Body-centred cubic: planes {110}, the 6 rectangles through opposite edges of the cube: 12 triangles.</summary>
        Bcc = 2,
        /// <summary>Face-centred cubic: planes {111}, the faces of the octet truss's tetrahedra and octahedra: 8 triangles between diagonals of the cube's faces.</summary>
        Fcc = 3,
        /// <summary>CUBIC, then FCC: 14 triangles. Thin plates are equally stiff in all directions if the first 6 triangles are 8 sqrt(3) / 9 = 1.5396 times as thick as the others.</summary>
        CubicOctet = 4,
        /// <summary>Faces of space-filling truncated octahedra, MSQ_UNIT_CELL_KELVIN closed: 72 triangles, the first 48 of hexagons, the others of squares.</summary>
        Kelvin = 5,
    }

    /// <summary>How sets, grids and slices of a foam are evaluated. All methods yield the same solid. POINT, METHOD_1 and METHOD_2 are those of the paper, for comparison. docs/benchmarks.md compares their cost. Single points (msq_point_membership) are always evaluated by the definition.</summary>
    public enum FoamMethod
    {
        /// <summary>The fastest method; now DIRECT.</summary>
        Auto = 0,
        /// <summary>The paper's naive query per point: gather seeds, form triplets with the nearest seed, project, validate.</summary>
        Point = 1,
        /// <summary>Per cell: edges of a Delaunay triangulation (CGAL), kept in the cache.</summary>
        Method2 = 2,
        /// <summary>Each Voronoi edge is built once, kept in the cache, and rasterised as spans. Arrays of points, and grids with few samples per cell, use the seeds near each point, grouped by cell, with SIMD.</summary>
        Direct = 3,
        /// <summary>Per cell: lines of seed triplets, kept in the cache and validated per point.</summary>
        Method1 = 4,
    }

    /// <summary>Functions of functional structures. x, y, z are 2 pi times the position in the cell.</summary>
    public enum Function
    {
        /// <summary>The expression of the definition.</summary>
        Expression = 0,
        /// <summary>sin x cos y + sin y cos z + sin z cos x</summary>
        Gyroid = 1,
        /// <summary>cos x + cos y + cos z</summary>
        SchwarzP = 2,
        /// <summary>sin x sin y sin z + sin x cos y cos z + cos x sin y cos z + cos x cos y sin z</summary>
        Diamond = 3,
        /// <summary>2 (cos x cos y + cos y cos z + cos z cos x) - (cos 2x + cos 2y + cos 2z)</summary>
        IWp = 4,
        /// <summary>3 (cos x + cos y + cos z) + 4 cos x cos y cos z</summary>
        Neovius = 5,
        /// <summary>4 cos x cos y cos z - (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x)</summary>
        FRd = 6,
        /// <summary>0.5 (sin 2x cos y sin z + sin 2y cos z sin x + sin 2z cos x sin y) - 0.5 (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x) + 0.15</summary>
        Lidinoid = 7,
        /// <summary>1.1 (sin 2x sin z cos y + sin 2y sin x cos z + sin 2z sin y cos x) - 0.2 (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x) - 0.4 (cos 2x + cos 2y + cos 2z)</summary>
        SplitP = 8,
        /// <summary>cos 2x sin y cos z + cos 2y sin z cos x + cos 2z sin x cos y.</summary>
        FischerKochS = 9,
        /// <summary>sin 2x sin y + sin 2y sin z + sin 2z sin x + sin 2x cos z + sin 2y cos x + sin 2z cos y - sin x sin y sin z - cos x cos y cos z: C(Y).</summary>
        CY = 10,
        /// <summary>sin 2x sin y + sin 2y sin z + sin 2z sin x - 2 cos x cos y cos z: C(+-Y).</summary>
        CPlusMinusY = 11,
        /// <summary>0.3 (cos x + cos y + cos z) + 0.3 (cos x cos y + cos y cos z + cos z cos x) - 0.4 (cos 2x + cos 2y + cos 2z) + 0.2.</summary>
        KarcherK = 12,
        /// <summary>sin 2x cos y sin z + sin 2y cos z sin x + sin 2z cos x sin y + 0.32: G'.</summary>
        GPrime = 13,
        /// <summary>cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x - 2.75 (sin 2x cos y sin z + sin 2y cos z sin x + sin 2z cos x sin y) + 0.95. The network is two labyrinths that do not touch. So are the networks of the next two functions.</summary>
        DoubleGyroid = 14,
        /// <summary>-0.5 (sin x sin y + sin y sin z + sin z sin x) - 0.5 cos x cos y cos z.</summary>
        DoubleDiamond = 15,
        /// <summary>-0.5 (cos x cos y + cos y cos z + cos z cos x) - 0.2 (cos 2x + cos 2y + cos 2z).</summary>
        DoubleP = 16,
        /// <summary>cos 2y + 2 cos x cos y + 0.5: columns along z with hexagonal holes, regular if the cell is sqrt(3) times as long along y as along x.</summary>
        Honeycomb = 17,
        /// <summary>1 - cos x - cos y: rods along z.</summary>
        Rods = 18,
    }

    /// <summary>Which points of a functional structure are solid.</summary>
    public enum FunctionalKind
    {
        /// <summary>Where the function is at most the level.</summary>
        Network = 1,
        /// <summary>Where the magnitude of the function is at most the level.</summary>
        Sheet = 2,
    }

    /// <summary>How a beam ends.</summary>
    public enum Cap
    {
        /// <summary>With a ball of the radius at that end. If the radii differ, the ball of the thicker end protrudes from the side of the beam.</summary>
        Sphere = 0,
        /// <summary>With the half of that ball beyond the end.</summary>
        Hemisphere = 1,
        /// <summary>Flat.</summary>
        Butt = 2,
    }

    /// <summary>Which part of the beams of a file belongs to the solid.</summary>
    public enum Clipping
    {
        None = 0,
        /// <summary>The part inside the clipping mesh.</summary>
        Inside = 1,
        /// <summary>The part outside the clipping mesh.</summary>
        Outside = 2,
    }

    /// <summary>A mesh of a file of beams.</summary>
    public enum BeamFileMesh
    {
        /// <summary>All triangles of the build: what is solid besides the beams. lattice must be 0.</summary>
        Solid = 0,
        /// <summary>The mesh that clips the lattice.</summary>
        Clipping = 1,
    }

    /// <summary>Membership of all points of a box.</summary>
    public enum BoxAnswer
    {
        /// <summary>Unknown, or neither of the others.</summary>
        Mixed = 0,
        Outside = 1,
        Inside = 2,
    }

    /// <summary>Which struts a box selects.</summary>
    public enum StrutsSelection
    {
        /// <summary>The struts whose middle is in the half-open box: min &lt;= middle &lt; max along each axis. Boxes that tile a region share no strut, and together they have those of the region. The middle is half the sum of the ends, rounded.</summary>
        Owned = 0,
        /// <summary>All struts that come near the closed box: the centre line meets the box, grown on all sides by the greatest radius that the strut may have. Every strut with a point in the box is among them. A strut may come near several boxes.</summary>
        Near = 1,
    }

    /// <summary>Material id of points outside the model.</summary>
    public enum MaterialId
    {
        Void = 0,
    }

    /// <summary>How structures evaluate the points of a set. Does not change results.</summary>
    public enum QueryMethod
    {
        /// <summary>Groups of points; groups with few points one at a time.</summary>
        Auto = 0,
        /// <summary>Each point by itself.</summary>
        Point = 1,
        /// <summary>Groups of nearby points, however small.</summary>
        Set = 2,
    }

    /// <summary>Kinds of point sets.</summary>
    public enum PointsKind
    {
        Array = 1,
        Grid = 2,
        Stratified = 3,
    }

    /// <summary>What msq_set_onset writes.</summary>
    public enum OnsetValue
    {
        /// <summary>The onset: the smallest radius, thickness or level at which the point is inside. Lattices and foams: the distance to the nearest strut axis in model units; with strut factors, the minimum of distance / factor. Plates and walls: the same with twice the distance to the nearest face. Functional structures: the function; waves: the sum; sheets: the magnitude of these. Unions of lattices of struts and foams of struts alone: the minimum of their onsets.</summary>
        Plain = 0,
        /// <summary>The onset minus the structure's radius or level at the point: at most 0 inside, positive outside. Unions: the minimum of these.</summary>
        Signed = 1,
    }

    /// <summary>What is measured.</summary>
    public enum Phase
    {
        Solid = 1,
        Void = 2,
    }

    /// <summary>Contents of a layer. Rows of pixels are padded with zeros to a multiple of 8 bytes.</summary>
    public enum LayerOutput
    {
        /// <summary>1 bit per pixel, sampled at its centre. The leftmost pixel is the high bit, as in PNG and PBM.</summary>
        Bits = 1,
        /// <summary>1 byte per pixel, sampled at its centre: 255 inside, 0 outside.</summary>
        Bytes = 2,
        /// <summary>1 byte per pixel: its coverage, from 0 to 255, by k x k samples with k = grey_samples. Sample (a, b), 0 &lt;= a, b &lt; k, lies at the centre of the pixel + ((a, b) + 1/2) / k * pitch - pitch / 2, the centre of its part of the pixel. With n samples inside the value is floor(255 * (n / k^2)^grey_gamma + 1/2), or 0 if that is below grey_threshold.</summary>
        Grey = 3,
        /// <summary>1 float32 per pixel: the signed distance at its centre, as msq_set_distance returns it, rounded to the nearest float32; outside at least 1.17549435e-38, so that the sign remains. Rows have the byte order of the machine.</summary>
        Distance = 4,
        /// <summary>1 uint32 per pixel: the id of the material at its centre, as msq_set_material returns it. A resolved scale must have a material.</summary>
        Material = 5,
        /// <summary>1 float32 per pixel: the onset of a structure at its centre, as msq_set_onset returns it, rounded to the nearest float32. The model must have one region.</summary>
        Onset = 6,
        /// <summary>No pixels: the rings that msq_slicer_contours returns. Only in msq_slicer_def.outputs.</summary>
        Contours = 7,
        /// <summary>1 float32 per pixel: the value of a channel of the material at its centre, as msq_set_material returns it, rounded to the nearest float32; 0 outside, and where the material has no such channel. Only in msq_slicer_def.outputs.</summary>
        Channel = 8,
    }

    /// <summary>How layers are mirrored and transposed for the panel of a printer before the host receives them. A sum of the values below. Let the layer have W x H pixels, after exchanging the sides of the plan if TRANSPOSE is set. Its pixel (i, j) is pixel (i', j') of the plan, where i' = W - 1 - i with MIRROR_X and i otherwise, j' = H - 1 - j with MIRROR_Y and j otherwise, and TRANSPOSE exchanges i' and j' at the end.</summary>
    public enum LayerOrientation
    {
        MirrorX = 1,
        MirrorY = 2,
        Transpose = 4,
    }

    /// <summary>Possible problems in printing layers. docs/concepts.md defines the kinds exactly.</summary>
    public enum FindingKind
    {
        /// <summary>A part of a layer, connected in the layer, that lies on no solid sample of the layer below.</summary>
        Island = 1,
        /// <summary>A connected part of the solid that does not reach the plate. Without a plate: any part except the one with the most samples.</summary>
        Loose = 2,
        /// <summary>An enclosed void, which traps resin or powder: connected empty samples that reach neither a side of the grid nor its top; without a plate, nor its bottom. One that begins in layer 0 is open at the plate only.</summary>
        Void = 4,
        /// <summary>Connected samples where the solid is thinner in its layer than a given width.</summary>
        Thin = 8,
        /// <summary>A cup: a void that is closed except where the next layer is printed, so it sucks at the film of a resin printer. In other words: empty samples that are connected within layers 0 to k, reach layer k, and reach neither a side of the grid nor, without a plate, its bottom. Each cup is listed once, for the last such k, which is its last_layer. Voids that close are listed as VOID only.</summary>
        Cup = 16,
        /// <summary>Connected samples of a layer with none below them, and none in the layer below within a given horizontal distance.</summary>
        Overhang = 32,
    }

    /// <summary>Formats of mesh files.</summary>
    public enum SurfaceFormat
    {
        /// <summary>Binary STL: triangles without common vertices, coordinates as float32.</summary>
        Stl = 1,
        /// <summary>Binary PLY, low bytes first: vertices with normals, as float32, and triangles.</summary>
        Ply = 2,
    }

    /// <summary>How the rays of a camera run: parallel, or from the eye.</summary>
    public enum Projection
    {
        Orthographic = 0,
        Perspective = 1,
    }

    /// <summary>Base colour of a surface.</summary>
    public enum ColourBy
    {
        /// <summary>colours[0]</summary>
        Plain = 0,
        /// <summary>colours[scale % colour_count]</summary>
        Scale = 1,
        /// <summary>colours[material id % colour_count]</summary>
        Material = 2,
        /// <summary>red, green, blue = (1 + normal) / 2</summary>
        Normal = 3,
    }

    /// <summary>Which files a document may name.</summary>
    public enum DocumentFiles
    {
        /// <summary>Relative paths below base_directory, without "..", colons and backslashes. Symbolic links there are followed.</summary>
        Below = 0,
        /// <summary>None.</summary>
        None = 1,
        /// <summary>Any: relative ones start at base_directory. For documents that the host trusts.</summary>
        Any = 2,
    }
}

namespace Msq.Interop
{
    /// <summary>Threads, cell cache and memory limit that objects share.</summary>
    public struct msq_context
    {
    }

    /// <summary>Progress and cancellation of one long call.</summary>
    public struct msq_job
    {
    }

    /// <summary>A coarse solid.</summary>
    public struct msq_shape
    {
    }

    /// <summary>A number at every point of space, with a known range.</summary>
    public struct msq_field
    {
    }

    /// <summary>A fine-scale structure: a solid in all space.</summary>
    public struct msq_structure
    {
    }

    /// <summary>The beam lattices of a file, and its mesh. Immutable; any thread may read it.</summary>
    public struct msq_beam_file
    {
    }

    /// <summary>Struts as arrays, joined at numbered nodes. Immutable; any thread may read it.</summary>
    public struct msq_strut_graph
    {
    }

    /// <summary>An id and named channels, for example density, modulus or colour.</summary>
    public struct msq_material
    {
    }

    /// <summary>A coarse shape and the structures that fill it, scale by scale.</summary>
    public struct msq_model
    {
    }

    /// <summary>A model and a plan of layers.</summary>
    public struct msq_slicer
    {
    }

    /// <summary>Rings of points: the section of a model with a plane. Immutable; any thread may read it.</summary>
    public struct msq_contours
    {
    }

    /// <summary>Lines that fill a polygon: paths for a nozzle that prints thin walls as single lines.</summary>
    public struct msq_fill
    {
    }

    /// <summary>A model with settings for slices and pictures, read from a text in JSON. docs/model_file.md defines the format, docs/model.schema.json is its schema.</summary>
    public struct msq_document
    {
    }

    /// <summary>How the loaded library was built.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_build_report
    {
        /// <summary>In: size of the caller's struct.</summary>
        public uint struct_size;
        /// <summary>As msq_version().</summary>
        public uint version;
        /// <summary>1 if all mesh formats are read. 0: no binary STL, 3MF and AMF.</summary>
        public int with_assimp;
        /// <summary>1 if MSQ_FOAM_METHOD_2 and msq_shape_self_intersections are available.</summary>
        public int with_cgal;
        /// <summary>SPDX licence of this binary together with the libraries it is built on. Static.</summary>
        public byte* licence;
        /// <summary>Instruction set that the kernels use on this machine, for example "AVX3". Static.</summary>
        public byte* simd;
        /// <summary>1 if msq_shape_hash and the other hash functions are available.</summary>
        public int with_xxhash;
        /// <summary>1 if documents are read and written (msq_document_from_json).</summary>
        public int with_json;
        /// <summary>1 if documents may name stacks of TIFF files.</summary>
        public int with_tiff;
        public uint reserved;
    }

    /// <summary>Receives a warning: something legal but doubtful. code: an msq_warning_code; later versions may add some. message: in UTF-8, with the values, valid until the callback returns.</summary>
    /// <remarks>
    /// <para>It is called on the thread that called msq, after the function that warns has done its work and before it returns. No lock is held, so the callback may call msq. A constructor has not written its handle yet. Exceptions of the host's language must not leave it.</para>
    /// </remarks>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void msq_warning_fn(void* user, int code, byte* message);

    /// <summary>Called once when an object is freed.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void msq_release_fn(void* user);

    /// <summary>One task of a loop of msq. It returns when its work is done and throws nothing. i: its number.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void msq_task_fn(void* task, ulong i);

    /// <summary>Shares the tasks of a loop among threads of the host: calls body(task, i) once for each i from 0 to count - 1 and returns when all these calls have returned. Pass task on unchanged.</summary>
    /// <remarks>
    /// <para>The calls may run on any threads, in any order, at once or one after the other on the calling thread. Several threads may call this function at the same time, also from within a task. Such a call must not wait for a thread to become free: where all are busy, the calling thread runs the tasks itself.</para>
    /// <para>Return 0 for success. Any other code, preferably negative, stops the call of msq with MSQ_E_HOST; tasks that have not begun may then be skipped. Exceptions of the host's language must not leave the function.</para>
    /// </remarks>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_parallel_for_fn(void* user, ulong count, IntPtr body, void* task);

    /// <summary>Definition of a context.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_context_def
    {
        public uint struct_size;
        /// <summary>Threads per call, including the caller. 0 (default): one per core; larger values are clamped to that, unless beyond_cores is 1. 1: the calling thread only. With parallel_for: tasks per loop, clamped to 1024.</summary>
        public uint threads;
        /// <summary>Maximum size of the cell cache in bytes. Default 1 GiB. 0: no cache. Does not change results.</summary>
        public ulong cache_bytes;
        /// <summary>Maximum number of bytes in use at one time for meshes, images, beams, slabs, cached cells, fill lines and file reading (8 times the size of the file). Cached cells are evicted to make room. 0 (default): no limit. Not counted: what a thread works on (about 5 MB per thread for foams, 1 to 36 MB in all for two threads and layers of 16384^2 or sets of 1e9 points, less than 1 MB for fill lines), working memory that is kept between calls (at most 16 MiB for most kinds), and arrays of the host. docs/howto/memory.md has a table.</summary>
        public ulong memory_limit;
        /// <summary>An msq_cache_policy. Default MSQ_CACHE_FIFO. Does not change results.</summary>
        public int cache_policy;
        /// <summary>1: there may be more threads than cores, up to 1024. This is for tests. 0 (default): at most one thread per core. Ignored with parallel_for. Does not change results.</summary>
        public uint beyond_cores;
        /// <summary>Receives warnings about objects of this context. NULL (default): none. Must be valid as long as the context. Models keep the context alive.</summary>
        public IntPtr warning;
        /// <summary>Passed to warning.</summary>
        public void* warning_user;
        /// <summary>Runs the loops of msq on threads of the host. msq then starts no thread of its own. NULL (default): threads of msq. Does not change results.</summary>
        public IntPtr parallel_for;
        /// <summary>First argument of parallel_for.</summary>
        public void* parallel_for_user;
        /// <summary>NULL, or called with parallel_for_user when the context is freed, on the thread that drops the last reference. Models and other objects keep references to their context. It is not called if msq_context_create fails.</summary>
        public IntPtr parallel_for_release;
        /// <summary>NULL, or called with warning_user when the context is freed, on the thread that drops the last reference. Models and other objects keep references to their context. It is not called if msq_context_create fails.</summary>
        public IntPtr warning_release;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_context_def Defaults()
        {
            msq_context_def made;
            MsqException.Check(Abi.msq_context_def_init(&made, (UIntPtr)sizeof(msq_context_def)));
            return made;
        }
    }

    /// <summary>Memory that is accounted to a context.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_memory_report
    {
        public uint struct_size;
        public uint reserved;
        /// <summary>Bytes in use now by meshes, images, beams, slabs and cached cells.</summary>
        public ulong bytes;
        /// <summary>Maximum of bytes so far.</summary>
        public ulong peak_bytes;
        /// <summary>The limit of the definition. 0: no limit.</summary>
        public ulong limit_bytes;
    }

    /// <summary>Counters of the cell cache.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_cache_report
    {
        public uint struct_size;
        public uint reserved;
        /// <summary>Cell lookups that found the cell; lookups that did not find it; evicted cells.</summary>
        public ulong hits;
        /// <summary>Cell lookups that found the cell; lookups that did not find it; evicted cells.</summary>
        public ulong misses;
        /// <summary>Cell lookups that found the cell; lookups that did not find it; evicted cells.</summary>
        public ulong evictions;
        /// <summary>Bytes in use now by cells and reserved for cells under construction. Never above limit_bytes.</summary>
        public ulong bytes;
        public ulong peak_bytes;
        public ulong limit_bytes;
        /// <summary>The part of bytes that is reserved for cells under construction.</summary>
        public ulong building_bytes;
        /// <summary>Number of cells in the cache now.</summary>
        public ulong cells;
        /// <summary>Misses for which two threads built the same cell at the same time.</summary>
        public ulong duplicates;
        /// <summary>Misses for which no room was found: the cell served one caller and was freed.</summary>
        public ulong unkept;
    }

    /// <summary>Which parts of the engine evaluated the points of a set query.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_job_report
    {
        public uint struct_size;
        public uint reserved;
        /// <summary>Points evaluated so far.</summary>
        public ulong points;
        /// <summary>Points decided by the coarse shape alone: they are outside it, or no finer scale is resolved.</summary>
        public ulong by_shape;
        /// <summary>Points that structures evaluated one at a time. A point counts once per structure.</summary>
        public ulong by_point;
        /// <summary>Points that structures evaluated in groups. A point counts once per structure.</summary>
        public ulong by_set;
        /// <summary>Number of these groups. On grids a group is a tile of rows.</summary>
        public ulong groups;
    }

    /// <summary>A part of a grid: the samples (i, j, k) with first &lt;= (i, j, k) &lt; first + count along each axis. All zeros (default): the whole grid. Otherwise each count is at least 1.</summary>
    /// <remarks>
    /// <para>Positions depend on the index in the whole grid alone: origin + (i, j, k) * spacing. So windows that tile a grid have, byte for byte, the results of the whole. A smaller grid with a shifted origin does not: its positions are rounded differently.</para>
    /// </remarks>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_window
    {
        /// <summary>Index of the first sample in the whole grid.</summary>
        public fixed ulong first[3];
        /// <summary>Number of samples along x, y and z.</summary>
        public fixed ulong count[3];
    }

    /// <summary>Writes values[i], the value at point i, for i &lt; count.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_values_fn(void* user, double* points, ulong count, double* values);

    /// <summary>Writes bounds of all values in the box from min to max. The bounds include rounding.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_range_fn(void* user, double* min, double* max, double* low, double* high);

    /// <summary>The grid of neighbourhood cells of a structure, or the frame of an image. Cell (i, j, k) contains the points origin + rotation * ((i, j, k) + u) * cell_size with 0 &lt;= u &lt; 1 in each component. Source: paper, section "Multiscale Shape-Material Modeling API".</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_neighbourhood
    {
        /// <summary>Default 0.</summary>
        public fixed double origin[3];
        /// <summary>Along the axes of the grid, 1e-75 to 1e75. Default 1.</summary>
        public fixed double cell_size[3];
        /// <summary>Row-major. Orthonormal within 1e-9 with determinant +1; msq takes the nearest rotation. Default identity.</summary>
        public fixed double rotation[9];
    }

    /// <summary>A graded period: cells whose size varies along one axis of a structure's grid. For example, it varies the spacing of walls that are printed with lines of constant width.</summary>
    /// <remarks>
    /// <para>The number of cells per unit length, 1 / size, is linear between positions and constant before the first and beyond the last. So the map from the coordinate to the number of cells from the grid's origin is monotone and has a continuous slope: surfaces have no kinks, and cells do not fold. grid.cell_size along this axis is ignored. The grid's origin is a corner of cells. The largest cell size is the structure's characteristic length. docs/concepts.md defines the map bit for bit. The arrays are copied.</para>
    /// </remarks>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_period_def
    {
        public uint struct_size;
        /// <summary>Axis of the grid, 0 to 2. Default 2.</summary>
        public int axis;
        /// <summary>count coordinates along that axis, in model units from the grid's origin, ascending. Two neighbours are at least 1e-6 times the smaller of their two cell sizes apart. No default.</summary>
        public double* positions;
        /// <summary>Size of the cells at each position, in model units, 1e-75 to 1e75. The largest is at most 1024 times the smallest. No default.</summary>
        public double* cell_sizes;
        /// <summary>1 to 4096.</summary>
        public ulong count;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_period_def Defaults()
        {
            msq_period_def made;
            MsqException.Check(Abi.msq_period_def_init(&made, (UIntPtr)sizeof(msq_period_def)));
            return made;
        }
    }

    /// <summary>Warped cells: cells around an axis, around a point, or placed by a map that the host samples. They take the place of boxes.</summary>
    /// <remarks>
    /// <para>CYLINDRICAL: the cells lie around the z axis of the structure's grid. SPHERICAL: they lie around the origin of the grid, the centre, and the z axis points to the north pole. Cells have three coordinates, each counted in cells: - x goes outwards: (r - inner_radius) / cell_size[0], with r the distance from the axis or the centre. - y goes around the z axis, from the x axis towards the y axis. A whole turn has count cells, so the pattern closes. cell_size[1] is not used. - z of CYLINDRICAL goes along the axis: z / cell_size[2]. z of SPHERICAL goes from the south pole to the north pole, with count_polar cells between them; cell_size[2] is not used. CYLINDRICAL cells may be sheared: msq adds shear_outwards times x and shear_along times z to y, and removes whole turns. The pattern closes around the axis for any shear. A positive shear turns the pattern from the y axis towards the x axis. Without a shear, the edges of cells on the positive x axis of the grid are parallel to the axes of the grid.</para>
    /// <para>Cells become wider with their distance from the axis. At the axis and at the poles their width is 0, so features there are arbitrarily small. The narrowest cells away from the poles are 2 pi inner_radius / count wide: choose inner_radius so that a printer can print cells of this width. Choose the shape so that it leaves out the poles.</para>
    /// <para>Cells fill the space from inner_radius to outer_radius. A functional structure is empty outside of this space, and so is a foam. A lattice has the whole cells that fit in it (msq_lattice_def.warp).</para>
    /// <para>SAMPLED: u, v and w are fields of samples (msq_field_grid) on one grid of at least 2 samples along each axis. msq interpolates the samples. The three values at a point are its coordinates, counted in cells, at most 2^22 in magnitude. Cells begin and end at whole numbers. The structure's grid is not used. The cells fill the box of the samples. A functional structure is empty outside of this box, and so is a foam. A lattice has the struts whose two nodes are in the box. So sample one cell more than the part needs.</para>
    /// <para>The map must not fold: the determinant of its derivatives has one sign in all voxels, is nowhere 0, and its magnitude is above 2^-40 times the product of the gradients' lengths. An angle that jumps by a whole turn is a fold. For a whole ring use CYLINDRICAL; a part of a ring may be sampled. If two points have the same coordinates, msq places the nodes of lattices and the seeds of foams at one of them. Cost: SAMPLED makes two passes over the samples, about 0.1 us per voxel. For lattices msq places all nodes in the box, about 1 us each; for foams all seeds, about 2 us each. Usually a place costs about 200 looks at voxels. A map in which all places together cost more than 1024 for each place, and more than 2^27, is refused (LIMIT): it has nearly the same coordinates too often.</para>
    /// <para>docs/concepts.md defines the map bit for bit.</para>
    /// </remarks>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_warp_def
    {
        public uint struct_size;
        /// <summary>An msq_warp_kind. Default MSQ_WARP_CYLINDRICAL.</summary>
        public int kind;
        /// <summary>CYLINDRICAL, SPHERICAL: cells around the z axis, 1 to 65536; no default. SAMPLED: 0.</summary>
        public uint count;
        /// <summary>SPHERICAL: cells from pole to pole, 1 to 65536; no default. Other kinds: 0.</summary>
        public uint count_polar;
        /// <summary>In model units, 0 to 1e75, and less than 2^24 cells. Default 0. SAMPLED: 0.</summary>
        public double inner_radius;
        /// <summary>In model units, above inner_radius, at most 1e75. 0 (default): no limit. SAMPLED: 0.</summary>
        public double outer_radius;
        /// <summary>SAMPLED: the coordinate x at each point, counted in cells. It is a field of msq_field_grid; those of v and w have the same grid. No default. Other kinds: NULL.</summary>
        public msq_field* u;
        /// <summary>SAMPLED: the coordinate y, as u.</summary>
        public msq_field* v;
        /// <summary>SAMPLED: the coordinate z, as u.</summary>
        public msq_field* w;
        /// <summary>CYLINDRICAL: number of cells by which the pattern turns around the axis per cell outwards, at most 65536 in magnitude. Default 0. Other kinds: 0.</summary>
        public double shear_outwards;
        /// <summary>CYLINDRICAL: the same per cell along the axis, as in a twisted rope. The pattern makes a whole turn in count / shear_along cells. Default 0. Other kinds: 0.</summary>
        public double shear_along;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_warp_def Defaults()
        {
            msq_warp_def made;
            MsqException.Check(Abi.msq_warp_def_init(&made, (UIntPtr)sizeof(msq_warp_def)));
            return made;
        }
    }

    /// <summary>Numbers on a regular grid, interpolated trilinearly. The values are copied, and msq keeps about 1/7 byte per value in addition.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_image
    {
        /// <summary>size[2] layers of size[1] rows of size[0] values.</summary>
        public void* values;
        /// <summary>MSQ_UINT8, INT16, UINT16, FLOAT32 or FLOAT64. No default. Floating-point values: at most 1e100 in magnitude.</summary>
        public int value_type;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        /// <summary>Number of values along x, y and z: 1 to 2^20 each.</summary>
        public fixed ulong size[3];
        /// <summary>Bytes from one row to the next. 0 (default): tightly packed.</summary>
        public ulong row_stride;
        /// <summary>Bytes from one layer to the next. 0 (default): size[1] rows.</summary>
        public ulong layer_stride;
        /// <summary>Value (i, j, k) is at origin + rotation * ((i, j, k) * cell_size): cell_size is the spacing of the values.</summary>
        public msq_neighbourhood grid;
    }

    /// <summary>How a mesh file is read.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_file_def
    {
        public uint struct_size;
        /// <summary>An msq_format. Default MSQ_FORMAT_AUTO, which needs a path.</summary>
        public int format;
        /// <summary>An msq_winding. Default MSQ_WINDING_AUTO.</summary>
        public int winding_rule;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        /// <summary>Length of the file's unit in mm for STL, OBJ, PLY and OFF, which name no unit. Default 1. The units of 3MF and AMF files are read and applied; that of glTF is the metre.</summary>
        public double unit_mm;
        /// <summary>Maximum size in bytes of the file, and of what an archive unpacks to. 0 and default: 4 GiB.</summary>
        public ulong max_bytes;
        /// <summary>Maximum number of triangles. 0 and default: 200 million.</summary>
        public ulong max_triangles;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_file_def Defaults()
        {
            msq_file_def made;
            MsqException.Check(Abi.msq_file_def_init(&made, (UIntPtr)sizeof(msq_file_def)));
            return made;
        }
    }

    /// <summary>A triangle mesh in arrays.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_mesh_def
    {
        public uint struct_size;
        /// <summary>MSQ_FLOAT32 or MSQ_FLOAT64 (default).</summary>
        public int coordinate_type;
        /// <summary>An msq_winding. Default MSQ_WINDING_AUTO.</summary>
        public int winding_rule;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        /// <summary>vertex_count triples x, y, z. No alignment is needed.</summary>
        public void* vertices;
        public ulong vertex_count;
        /// <summary>Bytes from one vertex to the next. 0 (default): tightly packed.</summary>
        public ulong vertex_stride;
        /// <summary>triangle_count triples of vertex indices, counter-clockwise seen from outside.</summary>
        public uint* triangles;
        public ulong triangle_count;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_mesh_def Defaults()
        {
            msq_mesh_def made;
            MsqException.Check(Abi.msq_mesh_def_init(&made, (UIntPtr)sizeof(msq_mesh_def)));
            return made;
        }
    }

    /// <summary>Writes inside[i]: 0 if point i is outside, any other value if it is inside or on the boundary.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_inside_fn(void* user, double* points, ulong count, byte* inside);

    /// <summary>A shape that the host computes.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_host_shape_def
    {
        public uint struct_size;
        /// <summary>0 (default) or 1. See "Objects that the host defines".</summary>
        public int concurrent;
        /// <summary>Membership of points in the bounding box, in model coordinates.</summary>
        public IntPtr inside;
        /// <summary>Lower bound on the distance to the boundary, for any points, on either side; its sign is ignored. It must have Lipschitz constant 1. NULL (default): the distance to the bounding box, 0 inside it.</summary>
        public IntPtr distance;
        public void* user;
        public IntPtr release;
        /// <summary>Bounding box, with the limits of msq_shape_from_box. No default.</summary>
        public fixed double min[3];
        /// <summary>Bounding box, with the limits of msq_shape_from_box. No default.</summary>
        public fixed double max[3];
        /// <summary>Represents the callbacks in hashes. Both 0 (default): no key.</summary>
        public fixed ulong hash_key[2];

        /// <summary>One with the defaults of msq.</summary>
        public static msq_host_shape_def Defaults()
        {
            msq_host_shape_def made;
            MsqException.Check(Abi.msq_host_shape_def_init(&made, (UIntPtr)sizeof(msq_host_shape_def)));
            return made;
        }
    }

    /// <summary>A shape from a voxel image.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_voxels_def
    {
        public uint struct_size;
        /// <summary>An msq_solid_side. Default MSQ_SOLID_ABOVE.</summary>
        public int solid;
        /// <summary>At least 2 values along each axis.</summary>
        public msq_image image;
        /// <summary>In the unit of the values. Default 0.</summary>
        public double threshold;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_voxels_def Defaults()
        {
            msq_voxels_def made;
            MsqException.Check(Abi.msq_voxels_def_init(&made, (UIntPtr)sizeof(msq_voxels_def)));
            return made;
        }
    }

    /// <summary>Bounds, size and diagnosis of a shape.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_shape_report
    {
        public uint struct_size;
        /// <summary>1 for a mesh, also a placed one. 0 for other shapes; their counts below are 0.</summary>
        public int is_mesh;
        /// <summary>Bounding box.</summary>
        public fixed double min[3];
        public fixed double max[3];
        /// <summary>Cubic model units. Meshes: signed sum over the triangles, exact for closed meshes up to rounding, negative if inside out. Open meshes with MSQ_WINDING_AUTO: that of the mesh with capped holes, without pieces whose caps exceed 3/4 of their area. Voxels: sum of the boxes of the solid values, as far as they are in the image's box. Host shapes, booleans and offsets: NaN.</summary>
        public double volume;
        /// <summary>Square model units. NaN for shapes without a formula: voxels, host shapes, booleans, offsets, stretched shapes. Meshes: infinite or 0 if sides of triangles are above 1e75 or below 1e-75.</summary>
        public double area;
        /// <summary>Vertices after welding.</summary>
        public ulong vertices;
        /// <summary>Triangles that were kept.</summary>
        public ulong triangles;
        /// <summary>Triangles without area. Those with fewer than three distinct vertices are dropped. Collinear ones are kept, because they close the surface.</summary>
        public ulong degenerate_triangles;
        /// <summary>Kept triangles with the same three vertices as an earlier one.</summary>
        public ulong duplicate_triangles;
        /// <summary>Edges with one triangle.</summary>
        public ulong open_edges;
        /// <summary>Edges with three or more triangles.</summary>
        public ulong non_manifold_edges;
        /// <summary>Edges with two triangles that run along the edge in the same direction.</summary>
        public ulong flipped_edges;
        /// <summary>1 if along every edge as many triangles run one way as the other.</summary>
        public int closed;
        public int reserved;
    }

    /// <summary>A field by the distance from a point or a line.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_radial_field_def
    {
        public uint struct_size;
        public uint reserved;
        /// <summary>Default 0.</summary>
        public fixed double center[3];
        /// <summary>Direction of the line through center, of any length. 0 (default): distance from the point center.</summary>
        public fixed double axis[3];
        /// <summary>At least 0. Default 0.</summary>
        public double from_radius;
        public double from_value;
        /// <summary>Greater than from_radius. Default 1.</summary>
        public double to_radius;
        public double to_value;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_radial_field_def Defaults()
        {
            msq_radial_field_def made;
            MsqException.Check(Abi.msq_radial_field_def_init(&made, (UIntPtr)sizeof(msq_radial_field_def)));
            return made;
        }
    }

    /// <summary>A field that the host computes.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_host_field_def
    {
        public uint struct_size;
        /// <summary>0 (default) or 1. See "Objects that the host defines".</summary>
        public int concurrent;
        /// <summary>Values at points of space, anywhere, in model coordinates.</summary>
        public IntPtr evaluate;
        /// <summary>Bounds over a box in model coordinates. NULL (default): derived from lipschitz.</summary>
        public IntPtr range;
        public void* user;
        public IntPtr release;
        /// <summary>Bounds of all values. Finite. No default.</summary>
        public double low;
        /// <summary>Bounds of all values. Finite. No default.</summary>
        public double high;
        /// <summary>Lipschitz constant of the values. Infinity (default): unknown.</summary>
        public double lipschitz;
        /// <summary>Represents the callbacks in hashes. Both 0 (default): no key.</summary>
        public fixed ulong hash_key[2];

        /// <summary>One with the defaults of msq.</summary>
        public static msq_host_field_def Defaults()
        {
            msq_host_field_def made;
            MsqException.Check(Abi.msq_host_field_def_init(&made, (UIntPtr)sizeof(msq_host_field_def)));
            return made;
        }
    }

    /// <summary>A field from an image.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_grid_field_def
    {
        public uint struct_size;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        public msq_image image;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_grid_field_def Defaults()
        {
            msq_grid_field_def made;
            MsqException.Check(Abi.msq_grid_field_def_init(&made, (UIntPtr)sizeof(msq_grid_field_def)));
            return made;
        }
    }

    /// <summary>A named number in an expression.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_named_value
    {
        /// <summary>Letters a to z and A to Z, digits and _; does not begin with a digit; not a name that expressions define; no name twice.</summary>
        public byte* name;
        public double value;
    }

    /// <summary>A field from an expression.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_expression_field_def
    {
        public uint struct_size;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        /// <summary>Text in the grammar of msq_structure_functional.</summary>
        public byte* expression;
        /// <summary>parameter_count names that the text may use.</summary>
        public msq_named_value* parameters;
        /// <summary>At most 1024.</summary>
        public ulong parameter_count;
        /// <summary>The value is clamped to this range. Finite, low &lt;= high. Default 0.</summary>
        public double low;
        /// <summary>The value is clamped to this range. Finite, low &lt;= high. Default 0.</summary>
        public double high;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_expression_field_def Defaults()
        {
            msq_expression_field_def made;
            MsqException.Check(Abi.msq_expression_field_def_init(&made, (UIntPtr)sizeof(msq_expression_field_def)));
            return made;
        }
    }

    /// <summary>A field by the signed distance to a shape.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_shape_distance_field_def
    {
        public uint struct_size;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        public msq_shape* shape;
        /// <summary>curve_count pairs (signed distance, value), strictly ascending in the first component, as in msq_field_map. Distances inside are negative.</summary>
        public double* curve;
        public ulong curve_count;
        /// <summary>0 (default): exact distance at every point. &gt; 0: spacing of samples that are interpolated trilinearly.</summary>
        public double step;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_shape_distance_field_def Defaults()
        {
            msq_shape_distance_field_def made;
            MsqException.Check(Abi.msq_shape_distance_field_def_init(&made, (UIntPtr)sizeof(msq_shape_distance_field_def)));
            return made;
        }
    }

    /// <summary>A parameter: the field, or value if field is NULL. Objects retain the fields of their parameters.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_param
    {
        public double value;
        public msq_field* field;
    }

    /// <summary>A unit cell: a named one, or nodes and struts.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_unit_cell_def
    {
        public uint struct_size;
        /// <summary>An msq_unit_cell. Default MSQ_UNIT_CELL_BCC.</summary>
        public int unit_cell;
        /// <summary>CUSTOM: node_count triples, in [0, 1].</summary>
        public double* nodes;
        /// <summary>1 to 4096.</summary>
        public ulong node_count;
        /// <summary>CUSTOM: strut_count pairs of indices of different nodes.</summary>
        public uint* struts;
        /// <summary>1 to 4096. A named cell needs it only with strut_factors.</summary>
        public ulong strut_count;
        /// <summary>Factor of the radius for each strut, 0.001 to 1000. NULL (default): all 1.</summary>
        public double* strut_factors;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_unit_cell_def Defaults()
        {
            msq_unit_cell_def made;
            MsqException.Check(Abi.msq_unit_cell_def_init(&made, (UIntPtr)sizeof(msq_unit_cell_def)));
            return made;
        }
    }

    /// <summary>Counts of a unit cell and the nodes that do not match their neighbours.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_unit_cell_report
    {
        public uint struct_size;
        /// <summary>1 if unmatched_count is 0.</summary>
        public int is_periodic;
        public ulong node_count;
        public ulong strut_count;
        /// <summary>Struts per cell of the tiling. Struts that coincide in neighbouring cells count once.</summary>
        public ulong tiled_strut_count;
        /// <summary>Total length of these struts in a cell of size 1.</summary>
        public double tiled_length;
        /// <summary>Nodes on the face at 0 of each axis.</summary>
        public fixed ulong low_nodes[3];
        /// <summary>Nodes on the face at 1 of each axis.</summary>
        public fixed ulong high_nodes[3];
        /// <summary>Nodes on both faces without a copy on the opposite face.</summary>
        public fixed ulong unmatched_nodes[3];
        /// <summary>Nodes without a copy along at least one axis.</summary>
        public ulong unmatched_count;
    }

    /// <summary>A periodic strut lattice.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_lattice_def
    {
        public uint struct_size;
        /// <summary>An msq_unit_cell. Default MSQ_UNIT_CELL_BCC. Ignored with a library.</summary>
        public int unit_cell;
        public msq_neighbourhood grid;
        /// <summary>Radius of the struts in model units. A constant must be &gt; 0, a field &gt;= 0. No default.</summary>
        public msq_param radius;
        /// <summary>CUSTOM: node_count triples, in [0, 1].</summary>
        public double* nodes;
        /// <summary>1 to 4096.</summary>
        public ulong node_count;
        /// <summary>CUSTOM: strut_count pairs of indices of different nodes.</summary>
        public uint* struts;
        /// <summary>1 to 4096. A named cell needs it only with strut_factors.</summary>
        public ulong strut_count;
        /// <summary>As in msq_unit_cell_def.</summary>
        public double* strut_factors;
        /// <summary>Library of cell_count unit cells, all with the same struct_size, with at most 4096 nodes and 4096 struts in total. NULL (default): the unit cell above.</summary>
        public msq_unit_cell_def* cells;
        /// <summary>1 to 256.</summary>
        public uint cell_count;
        /// <summary>The cell is divided into this many clusters along each axis to find the struts near points of arrays. 1 (none) to 64. 0 (default): chosen by cost. Ignored with a library. Does not change results.</summary>
        public uint clusters;
        /// <summary>With a library: index of the unit cell of each neighbourhood cell. It is evaluated at the cell's centre, rounded half up, and clamped to the library.</summary>
        public msq_param cell_choice;
        /// <summary>Cells whose size varies along an axis of the grid; grid.cell_size along that axis is ignored. The nodes move with the cells; struts stay straight and keep their radius. Not with a library of several unit cells. NULL (default): all cells have one size.</summary>
        public msq_period_def* period;
        /// <summary>Warped cells. The nodes move with the cells. The struts between nodes stay straight and keep their radius, so few cells around an axis make coarse rings. A cell may span at most 150 degrees: (1 + |shear_outwards| + |shear_along|) * 360 / count, and 180 / count_polar more if SPHERICAL. There are as many whole cells as fit between the radii. Struts of the first and the last cells reach beyond the radii by their own radius. Not with a period, nor with a library of several unit cells. NULL (default): cells are boxes.</summary>
        public msq_warp_def* warp;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_lattice_def Defaults()
        {
            msq_lattice_def made;
            MsqException.Check(Abi.msq_lattice_def_init(&made, (UIntPtr)sizeof(msq_lattice_def)));
            return made;
        }
    }

    /// <summary>Faces between unlike cells of a lattice.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_lattice_faces_report
    {
        public uint struct_size;
        /// <summary>Axis of the grid normal to the first unmatched face: 0, 1 or 2. -1: there is none, and the fields below cell are 0.</summary>
        public int axis;
        /// <summary>Cells that were examined.</summary>
        public ulong cells;
        /// <summary>Faces between two of them with different unit cells.</summary>
        public ulong faces;
        /// <summary>Faces with a node on one side that has no copy on the other.</summary>
        public ulong unmatched;
        /// <summary>Index of the cell below the first unmatched face. The other cell is the next one along the axis. Cells are ordered by z, then y, then x.</summary>
        public fixed int cell[3];
        public uint reserved;
        /// <summary>Library indices of the unit cells in these two cells.</summary>
        public fixed uint types[2];
        /// <summary>Centre of the face in model units.</summary>
        public fixed double point[3];
    }

    /// <summary>A periodic lattice of plates, or of plates and struts.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_plate_lattice_def
    {
        public uint struct_size;
        /// <summary>An msq_plate_cell. Default MSQ_PLATE_CELL_CUBIC.</summary>
        public int plate_cell;
        public msq_neighbourhood grid;
        /// <summary>Whole thickness of the plates in model units. A constant must be &gt; 0, a field &gt;= 0. No default.</summary>
        public msq_param thickness;
        /// <summary>node_count triples, in [0, 1]: the nodes of CUSTOM plates and of CUSTOM struts.</summary>
        public double* nodes;
        /// <summary>1 to 4096.</summary>
        public ulong node_count;
        /// <summary>CUSTOM: face_count triples of indices of different nodes, not on a line: the area of a triangle in model units must be at least 1e-5 of the square of its longest side.</summary>
        public uint* faces;
        /// <summary>1 to 4096. A named cell needs it only with face_factors.</summary>
        public ulong face_count;
        /// <summary>Factor of the thickness for each face, 0.001 to 1000. NULL (default): all 1.</summary>
        public double* face_factors;
        /// <summary>Radius of the struts in model units, &gt;= 0. The constant 0 (default): no struts.</summary>
        public msq_param radius;
        /// <summary>Unit cell of the struts, an msq_unit_cell. Default MSQ_UNIT_CELL_CUBIC. Ignored without struts.</summary>
        public int unit_cell;
        public uint reserved;
        /// <summary>With unit_cell CUSTOM: strut_count pairs of indices of different nodes.</summary>
        public uint* struts;
        /// <summary>1 to 4096. A named cell needs it only with strut_factors.</summary>
        public ulong strut_count;
        /// <summary>As in msq_unit_cell_def.</summary>
        public double* strut_factors;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_plate_lattice_def Defaults()
        {
            msq_plate_lattice_def made;
            MsqException.Check(Abi.msq_plate_lattice_def_init(&made, (UIntPtr)sizeof(msq_plate_lattice_def)));
            return made;
        }
    }

    /// <summary>A Voronoi foam: open-cell (struts), closed-cell (walls), or with both.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_foam_def
    {
        public uint struct_size;
        /// <summary>An msq_foam_method.</summary>
        public int method;
        public msq_neighbourhood grid;
        /// <summary>Radius of the struts in model units. A constant must be &gt; 0, a field &gt;= 0. No default. With walls, the constant 0 means no struts.</summary>
        public msq_param radius;
        /// <summary>0: seeds at the cell centres. 1 (default): anywhere in their cells.</summary>
        public double jitter;
        /// <summary>Selects the foam. Default 0.</summary>
        public ulong seed;
        /// <summary>Seeds per cell volume, up to 32768. Values below 1 count as 1 (default).</summary>
        public msq_param density;
        /// <summary>Whole thickness of the walls between the cells of the foam, in model units, &gt;= 0. The constant 0 (default): no walls.</summary>
        public msq_param wall_thickness;
        /// <summary>Radius of the hole through the middle of each wall, in model units, &gt;= 0. A field is evaluated at the middle of the wall. Walls with less area than their hole stay whole. Radii below 1/512 of the largest cell size count as 0. The constant 0 (default): no holes. Otherwise wall_thickness must not be the constant 0.</summary>
        public msq_param vent_radius;
        /// <summary>How much longer the cells of the foam are along each axis of the grid: 1/16 to 16, default 1. The Voronoi diagram measures lengths along axis i divided by stretch[i]. Struts stay circular, and walls keep their thickness. Only the proportions of the three numbers count; cell_size[i] / stretch[i] may differ by a factor of up to 16. Turn the grid for other directions.</summary>
        public fixed double stretch[3];
        /// <summary>The greatest radius of the seeds' spheres, in model units, from 0 (default) to the smallest cell size. Each seed has a radius r from 0 to weight by a hash. A point p is in the cell of the seed s for which |p - s|^2 - r^2 is least: this is the Laguerre tessellation (power diagram) of the spheres. Cells then differ more in size, and some seeds have none. Seeds stay where they are. 0: the Voronoi diagram.</summary>
        public double weight;
        /// <summary>Cells whose size varies along an axis of the grid, by a factor of at most 16; grid.cell_size along that axis is ignored. The largest cell sizes along the three axes may differ by a factor of up to 4. The seeds move with the cells, and the Voronoi diagram is that of the moved seeds. Struts stay straight and keep their radius; walls keep their thickness. The limits of radius, wall_thickness and vent_radius refer to the smallest cell size. With a period, method must be AUTO or DIRECT, density must not exceed 1, the three numbers of stretch must be equal, and weight must be 0. NULL (default): all cells have one size.</summary>
        public msq_period_def* period;
        /// <summary>Cells around the z axis of the grid, around its origin, or by a sampled map. Each cell has a seed, and the Voronoi diagram is that of the seeds in model space. Struts stay straight and keep their radius; walls keep their thickness.</summary>
        /// <remarks>
        /// <para>CYLINDRICAL, SPHERICAL: outer_radius must be above 0. Around a point count must be at least 3 and count_polar at least 2. Cells go on beyond inner_radius and outer_radius, so those at the two radii are like those between them. The foam is cut off there. Between the radii, cell sizes may differ by a factor of up to 16: grid.cell_size[0]; the width 2 pi r / count at a distance r from the axis, or at the equator; and grid.cell_size[2], or pi r / count_polar around a point.</para>
        /// <para>SAMPLED: the foam is cut off at the box of the samples. At the faces of this box, cells of the foam differ in size from others: sample one cell more than the part needs. The smallest cell size is 1 over the greatest slope of the map. The longest edge of a cell, in the middle of any voxel, may be 16 times as long. The ranges of u, v and w, in whole cells, may have a product of 2^24. The seeds count against the memory limit.</para>
        /// <para>The limits of radius, wall_thickness and vent_radius refer to the smallest cell. With a warp, method must be AUTO or DIRECT, density must not exceed 1, the three numbers of stretch must be equal, weight must be 0, and period must be NULL. NULL (default): cells are boxes.</para>
        /// </remarks>
        public msq_warp_def* warp;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_foam_def Defaults()
        {
            msq_foam_def made;
            MsqException.Check(Abi.msq_foam_def_init(&made, (UIntPtr)sizeof(msq_foam_def)));
            return made;
        }
    }

    /// <summary>A functional structure.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_functional_def
    {
        public uint struct_size;
        /// <summary>An msq_function. Default MSQ_FUNCTION_GYROID.</summary>
        public int function;
        /// <summary>An msq_functional_kind. Default MSQ_FUNCTIONAL_NETWORK.</summary>
        public int kind;
        /// <summary>The cell is divided into this many clusters along each axis to decide whole blocks at once. 1 (none) to 64. 0 (default): chosen by cost. Does not change results.</summary>
        public uint clusters;
        /// <summary>One period per cell.</summary>
        public msq_neighbourhood grid;
        /// <summary>Value of the function, not a length. Default 0. SHEET: a constant must be &gt; 0, a field &gt;= 0 and not 0 everywhere; or give thickness instead.</summary>
        public msq_param level;
        /// <summary>EXPRESSION: text in the grammar below. Otherwise NULL.</summary>
        public byte* expression;
        /// <summary>EXPRESSION: parameter_count names that the text may use.</summary>
        public msq_named_value* parameters;
        /// <summary>At most 1024.</summary>
        public ulong parameter_count;
        /// <summary>SHEET, instead of level: mean wall thickness in model units. A constant must be &gt; 0, a field &gt;= 0 and not 0 everywhere. With a period it must be a constant. Default 0: level is used.</summary>
        public msq_param thickness;
        /// <summary>Cells of varying size. NULL (default): all cells have the size of the grid.</summary>
        public msq_period_def* period;
        /// <summary>Warped cells. NULL (default): cells are boxes. Not together with a period or a thickness.</summary>
        public msq_warp_def* warp;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_functional_def Defaults()
        {
            msq_functional_def made;
            MsqException.Check(Abi.msq_functional_def_init(&made, (UIntPtr)sizeof(msq_functional_def)));
            return made;
        }
    }

    /// <summary>A sum of waves.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_waves_def
    {
        public uint struct_size;
        /// <summary>An msq_functional_kind. Default MSQ_FUNCTIONAL_NETWORK.</summary>
        public int kind;
        /// <summary>Picks the directions and phases. Default 0.</summary>
        public ulong seed;
        /// <summary>Number of waves, 1 to 4096. Default 256.</summary>
        public uint count;
        /// <summary>Cells along each axis of the grid after which the structure repeats, up to 2^20. 0 (default): it need not. Wave vectors are rounded to those that fit.</summary>
        public fixed uint tile[3];
        /// <summary>Half-angles of cones about the axes of the grid, in degrees: 0 (no cone) or 0.1 to 90, at least one above 0. The waves have directions in these cones. Default 90, 0, 0: all directions. One small cone: layers across the axis; two: columns along the third axis; three: a cubic structure.</summary>
        public fixed double cone_angles[3];
        /// <summary>cell_size: the wavelength along each axis of the grid.</summary>
        public msq_neighbourhood grid;
        /// <summary>Value of the sum, not a length. The sum has variance 1. Default 0: half of the volume. SHEET: a constant must be &gt; 0, a field &gt;= 0 and not 0 everywhere.</summary>
        public msq_param level;
        /// <summary>In place of a level: the volume fraction of a Gaussian random field, above 0 and below 1. 0 (default): level is used.</summary>
        public double volume_fraction;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_waves_def Defaults()
        {
            msq_waves_def made;
            MsqException.Check(Abi.msq_waves_def_init(&made, (UIntPtr)sizeof(msq_waves_def)));
            return made;
        }
    }

    /// <summary>A list of beams. Strides are bytes from one element to the next; 0 (default): tightly packed. No alignment is needed.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_beams_def
    {
        public uint struct_size;
        /// <summary>An msq_cap for all ends, unless caps is given. Default MSQ_CAP_SPHERE.</summary>
        public int cap;
        /// <summary>Of nodes, radii and ball_radii: MSQ_FLOAT32 or MSQ_FLOAT64 (default).</summary>
        public int coordinate_type;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        /// <summary>node_count triples x, y, z.</summary>
        public void* nodes;
        public ulong node_count;
        public ulong node_stride;
        /// <summary>beam_count pairs of node indices.</summary>
        public uint* beams;
        public ulong beam_count;
        public ulong beam_stride;
        /// <summary>beam_count pairs: radius at the first and at the second node. NULL (default): radius.</summary>
        public void* radii;
        public ulong radius_stride;
        /// <summary>beam_count pairs of msq_cap, at the first and at the second node. NULL (default): cap.</summary>
        public byte* caps;
        public ulong cap_stride;
        /// <summary>ball_count node indices: balls in addition to those of the caps.</summary>
        public uint* balls;
        public ulong ball_count;
        public ulong ball_stride;
        /// <summary>ball_count numbers. NULL (default): ball_radius.</summary>
        public void* ball_radii;
        public ulong ball_radius_stride;
        /// <summary>Radius of all beams if radii is NULL. No default.</summary>
        public double radius;
        /// <summary>Radius of all balls if ball_radii is NULL. No default.</summary>
        public double ball_radius;
        /// <summary>In model units. Shorter beams are dropped. Default 0.</summary>
        public double min_length;
        /// <summary>Characteristic length of the scale. 0 (default): the longest beam, or the largest diameter if that is more.</summary>
        public double length_scale;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_beams_def Defaults()
        {
            msq_beams_def made;
            MsqException.Check(Abi.msq_beams_def_init(&made, (UIntPtr)sizeof(msq_beams_def)));
            return made;
        }
    }

    /// <summary>Contents of a lattice of a file.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_beam_file_report
    {
        public uint struct_size;
        /// <summary>An msq_clipping.</summary>
        public int clipping;
        /// <summary>Lattices of the file.</summary>
        public ulong lattice_count;
        /// <summary>Triangles of the build. 0: there is no mesh.</summary>
        public ulong mesh_triangle_count;
        /// <summary>The following members describe the lattice.</summary>
        public ulong node_count;
        public ulong beam_count;
        public ulong ball_count;
        /// <summary>Triangles of the clipping mesh.</summary>
        public ulong clipping_triangle_count;
        /// <summary>Corners of a box that contains all beams and balls, in millimetres. Not clipped.</summary>
        public fixed double min[3];
        public fixed double max[3];
    }

    /// <summary>Points that a host structure evaluates. Valid until the callback returns.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_host_points
    {
        /// <summary>Out: sizeof(msq_host_points) of the library.</summary>
        public uint struct_size;
        public uint reserved;
        /// <summary>At most 4096.</summary>
        public ulong count;
        /// <summary>Triples x, y, z in model coordinates.</summary>
        public double* points;
        /// <summary>Triples: offset from the corner of the point's cell, in model units along the axes of the grid, from 0 to the cell size.</summary>
        public double* positions;
        /// <summary>Triples i, j, k: the cell of each point.</summary>
        public int* cells;
    }

    /// <summary>Writes inside[i]: 0 if point i is outside, any other value if it is inside or on the boundary.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_points_inside_fn(void* user, msq_host_points* points, byte* inside);

    /// <summary>Writes distances[i]: a lower bound on the distance from point i to the boundary, on either side, with Lipschitz constant 1. The sign is ignored.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_points_distance_fn(void* user, msq_host_points* points, double* distances);

    /// <summary>Builds the data of a cell. *data: the data, may be NULL. *bytes: its size in memory.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_build_cell_fn(void* user, int* cell, void** data, ulong* bytes);

    /// <summary>As msq_points_inside_fn, for points in the one cell that data belongs to.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_evaluate_cell_fn(void* user, void* data, msq_host_points* points, byte* inside);

    /// <summary>Frees data of a cell. data is not NULL.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void msq_free_cell_fn(void* user, void* data);

    /// <summary>Writes *answer, an msq_box_answer, for the closed box from min to max in model coordinates.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_box_fn(void* user, double* min, double* max, int* answer);

    /// <summary>A structure that the host computes. inside, or both build_cell and evaluate_cell, must be given. If all are given, inside evaluates single points and evaluate_cell sets.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_host_structure_def
    {
        public uint struct_size;
        /// <summary>0 (default) or 1. See "Objects that the host defines".</summary>
        public int concurrent;
        public msq_neighbourhood grid;
        public IntPtr inside;
        public IntPtr build_cell;
        public IntPtr evaluate_cell;
        /// <summary>May be NULL.</summary>
        public IntPtr free_cell;
        /// <summary>May be NULL. With it, msq skips the points of boxes without boundary.</summary>
        public IntPtr box;
        /// <summary>May be NULL: the distance bound is then 0, which is correct but does not help sphere tracing.</summary>
        public IntPtr distance;
        public void* user;
        /// <summary>May be NULL.</summary>
        public IntPtr release;
        /// <summary>Represents the callbacks in hashes. Both 0 (default): no key.</summary>
        public fixed ulong hash_key[2];

        /// <summary>One with the defaults of msq.</summary>
        public static msq_host_structure_def Defaults()
        {
            msq_host_structure_def made;
            MsqException.Check(Abi.msq_host_structure_def_init(&made, (UIntPtr)sizeof(msq_host_structure_def)));
            return made;
        }
    }

    /// <summary>A functional structure whose function the host computes.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_host_function_def
    {
        public uint struct_size;
        /// <summary>0 (default) or 1. See "Objects that the host defines".</summary>
        public int concurrent;
        /// <summary>An msq_functional_kind. Default MSQ_FUNCTIONAL_NETWORK.</summary>
        public int kind;
        /// <summary>As in msq_functional_def. Ignored if neither range nor lipschitz is given.</summary>
        public uint clusters;
        /// <summary>One period per cell.</summary>
        public msq_neighbourhood grid;
        /// <summary>As in msq_functional_def.</summary>
        public msq_param level;
        /// <summary>Values at triples of angles: 2 pi times the position in the cell, 0 to 2 pi.</summary>
        public IntPtr evaluate;
        /// <summary>Bounds over a box of angles, from -1e-9 to 2 pi + 1e-9. NULL (default): derived from lipschitz.</summary>
        public IntPtr range;
        public void* user;
        public IntPtr release;
        /// <summary>Lipschitz constant of the values with respect to the angles. Infinity (default): unknown.</summary>
        public double lipschitz;
        /// <summary>Represents the callbacks in hashes. Both 0 (default): no key.</summary>
        public fixed ulong hash_key[2];

        /// <summary>One with the defaults of msq.</summary>
        public static msq_host_function_def Defaults()
        {
            msq_host_function_def made;
            MsqException.Check(Abi.msq_host_function_def_init(&made, (UIntPtr)sizeof(msq_host_function_def)));
            return made;
        }
    }

    /// <summary>A strut, or a piece of one: a segment of the centre lines of a structure. Two struts, or two nodes, are the same if and only if both numbers of their ids are equal.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_strut
    {
        /// <summary>Depends on the definition of the structure alone, not on the box, threads or machine.</summary>
        public fixed ulong id[2];
        /// <summary>Id of the node at a. Struts that meet in a node have the same id there, and the same coordinates, bit for bit.</summary>
        public fixed ulong node_a[2];
        /// <summary>Id of the node at b.</summary>
        public fixed ulong node_b[2];
        /// <summary>First end in model units.</summary>
        public fixed double a[3];
        /// <summary>Second end.</summary>
        public fixed double b[3];
        /// <summary>Radius at a and at b, in model units. A field of radius is evaluated at the ends.</summary>
        public fixed double radii[2];
        /// <summary>Cell of the grid that owns the strut. Beams: 0.</summary>
        public fixed int cell[3];
        /// <summary>An msq_cap for each end. MSQ_CAP_SPHERE except for beams.</summary>
        public fixed byte caps[2];
        /// <summary>1: this end is where the strut leaves the shape. 0: a node of the structure.</summary>
        public fixed byte cut[2];
    }

    /// <summary>Receives count struts, valid until the callback returns. A return value other than 0 stops the call with MSQ_E_HOST.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_struts_fn(void* user, msq_strut* struts, ulong count);

    /// <summary>Selects struts of a structure.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_struts_def
    {
        public uint struct_size;
        /// <summary>An msq_struts_selection. Default MSQ_STRUTS_OWNED.</summary>
        public int selection;
        /// <summary>Corners of the box in model units, min &lt;= max. Default 0.</summary>
        public fixed double min[3];
        public fixed double max[3];
        /// <summary>Struts are cut to this shape. NULL (default): they are not cut. Whole struts are selected, so pieces of one strut come together.</summary>
        public msq_shape* shape;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_struts_def Defaults()
        {
            msq_struts_def made;
            MsqException.Check(Abi.msq_struts_def_init(&made, (UIntPtr)sizeof(msq_struts_def)));
            return made;
        }
    }

    /// <summary>Contents of a graph of struts. Pointers are valid as long as the graph is.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_strut_graph_report
    {
        public uint struct_size;
        public uint reserved;
        public ulong node_count;
        public ulong strut_count;
        /// <summary>node_count triples x, y, z in model units.</summary>
        public double* nodes;
        /// <summary>node_count pairs, as in msq_strut.</summary>
        public ulong* node_ids;
        /// <summary>strut_count pairs of indices of nodes: at a and at b.</summary>
        public uint* struts;
        /// <summary>strut_count pairs: radius at a and at b.</summary>
        public double* radii;
        /// <summary>strut_count pairs, as in msq_strut.</summary>
        public ulong* strut_ids;
        /// <summary>strut_count triples, as in msq_strut.</summary>
        public int* cells;
        /// <summary>strut_count pairs of msq_cap.</summary>
        public byte* caps;
        /// <summary>strut_count pairs: 1 for an end where the strut leaves the shape.</summary>
        public byte* cuts;
    }

    /// <summary>A named channel of a material.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_channel
    {
        /// <summary>1 to 255 bytes.</summary>
        public byte* name;
        public msq_param value;
    }

    /// <summary>A material.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_material_def
    {
        public uint struct_size;
        /// <summary>Positive. The host chooses its meaning. No default.</summary>
        public uint id;
        /// <summary>channel_count channels with distinct names.</summary>
        public msq_channel* channels;
        /// <summary>At most 256.</summary>
        public ulong channel_count;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_material_def Defaults()
        {
            msq_material_def made;
            MsqException.Check(Abi.msq_material_def_init(&made, (UIntPtr)sizeof(msq_material_def)));
            return made;
        }
    }

    /// <summary>One scale of a model. Zero-initialise it, then set what you need; fields may be added.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_scale_def
    {
        /// <summary>Scale 0: the shape. Other scales: NULL.</summary>
        public msq_shape* shape;
        /// <summary>Scales 1 and finer: the structure. Scale 0: NULL.</summary>
        public msq_structure* structure;
        /// <summary>Thickness, in model units, of the solid skin that the scale leaves under the surface of the coarse shape. At least 0 everywhere. 0: none. Not for scale 0, nor in shapes without depth.</summary>
        public msq_param skin;
        /// <summary>Material of what the scale resolves. NULL: that of the next coarser scale.</summary>
        public msq_material* material;
        /// <summary>Material of the skin. NULL: material. Not for scale 0.</summary>
        public msq_material* skin_material;
    }

    /// <summary>A model.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_model_def
    {
        public uint struct_size;
        /// <summary>1 to 64.</summary>
        public uint scale_count;
        /// <summary>Coarsest first: a shape, then structures.</summary>
        public msq_scale_def* scales;
        /// <summary>sizeof(msq_scale_def) of the caller. A multiple of 8. 0 (default): that of version 0.2.</summary>
        public uint scale_size;
        /// <summary>Must be 0.</summary>
        public uint reserved;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_model_def Defaults()
        {
            msq_model_def made;
            MsqException.Check(Abi.msq_model_def_init(&made, (UIntPtr)sizeof(msq_model_def)));
            return made;
        }
    }

    /// <summary>Options of a query.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_query_def
    {
        public uint struct_size;
        /// <summary>An msq_query_method, for msq_set_membership. Default MSQ_QUERY_AUTO.</summary>
        public int method;
        /// <summary>Scales with a characteristic length of at least this are resolved; finer ones are solid. 0 (default): all. Infinity: the coarse shape only.</summary>
        public double length_scale;
        /// <summary>AUTO: minimum number of points in a group that is evaluated as a set. 0 (default): measured for each kind of structure.</summary>
        public ulong critical_count;
        /// <summary>msq groups the points of an array by parts of a cell, this many along each axis, if the parts hold hundreds of points. 1 (by cell) to 64, rounded down to a power of 2. 0 (default): measured. Does not change results.</summary>
        public uint group_parts;
        /// <summary>Must be 0.</summary>
        public uint reserved;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_query_def Defaults()
        {
            msq_query_def made;
            MsqException.Check(Abi.msq_query_def_init(&made, (UIntPtr)sizeof(msq_query_def)));
            return made;
        }
    }

    /// <summary>A set of points.</summary>
    /// <remarks>
    /// <para>ARRAY: count points in any order. GRID: point (i, j, k) is origin + (i, j, k) * spacing and has index i + nx * (j + ny * k). With a window, the set is the points of the window, and point window.first + (i, j, k) has index i + window.count[0] * (j + window.count[1] * k). STRATIFIED: per_cell uniformly random points in each cell of a box of nx * ny * nz cells. Cell (i, j, k) has its corner at origin + rotation * ((i, j, k) * spacing) and its size is spacing. Its point s has index s + per_cell * (i + nx * (j + ny * k)). Points are a function of their index and the seed, equal on every machine, and are never stored.</para>
    /// </remarks>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_points_def
    {
        public uint struct_size;
        /// <summary>An msq_points_kind. No default.</summary>
        public int kind;
        /// <summary>ARRAY: count triples x, y, z. No alignment is needed.</summary>
        public void* coordinates;
        /// <summary>ARRAY.</summary>
        public ulong count;
        /// <summary>ARRAY: bytes from one point to the next. 0 (default): tightly packed.</summary>
        public ulong stride;
        /// <summary>ARRAY: MSQ_FLOAT32 or MSQ_FLOAT64 (default).</summary>
        public int coordinate_type;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        /// <summary>GRID, STRATIFIED.</summary>
        public fixed double origin[3];
        /// <summary>GRID, STRATIFIED. Positive. GRID: large enough that rounding keeps neighbours apart.</summary>
        public fixed double spacing[3];
        /// <summary>GRID, STRATIFIED: nx, ny, nz, each 1 to 2^31 - 1; fewer than 2^63 points in total, or in the window.</summary>
        public fixed ulong counts[3];
        /// <summary>STRATIFIED: selects the sample. Default 0.</summary>
        public ulong seed;
        /// <summary>STRATIFIED: at least 1 (default). Standard errors need at least 2.</summary>
        public uint per_cell;
        /// <summary>Must be 0.</summary>
        public uint reserved2;
        /// <summary>STRATIFIED: as in msq_neighbourhood. Default identity.</summary>
        public fixed double rotation[9];
        /// <summary>GRID: the points of the set. All zeros (default): the whole grid.</summary>
        public msq_window window;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_points_def Defaults()
        {
            msq_points_def made;
            MsqException.Check(Abi.msq_points_def_init(&made, (UIntPtr)sizeof(msq_points_def)));
            return made;
        }
    }

    /// <summary>An estimate of a number between 0 and 1.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_estimate
    {
        public double value;
        /// <summary>From the spread within the cells of the sample.</summary>
        public double standard_error;
        /// <summary>95 % confidence interval (Wilson).</summary>
        public double low;
        /// <summary>95 % confidence interval (Wilson).</summary>
        public double high;
    }

    /// <summary>Segments for correlations. One segment of each length starts at each point of the sample.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_segments_def
    {
        public uint struct_size;
        /// <summary>An msq_phase. Default MSQ_PHASE_SOLID.</summary>
        public int phase;
        /// <summary>Direction of all segments, of any length. 0 (default): each point has its own, uniform on the sphere, a function of its index and the seed.</summary>
        public fixed double direction[3];
        /// <summary>length_count lengths, finite, not negative, in any order.</summary>
        public double* lengths;
        /// <summary>1 to 4096.</summary>
        public ulong length_count;
        /// <summary>Step of msq_lineal_path in model units. 0 (default): 1/256 of the smallest characteristic length that is resolved (msq_model_scale_length), or of the longest length if that is smaller.</summary>
        public double step;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_segments_def Defaults()
        {
            msq_segments_def made;
            MsqException.Check(Abi.msq_segments_def_init(&made, (UIntPtr)sizeof(msq_segments_def)));
            return made;
        }
    }

    /// <summary>Result of a calibration.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_calibration_report
    {
        public uint struct_size;
        public uint reserved;
        /// <summary>Points that were evaluated.</summary>
        public ulong samples;
        /// <summary>Smallest parameter at which at least the target fraction of the points is solid.</summary>
        public double parameter;
        /// <summary>Volume fraction at that parameter.</summary>
        public msq_estimate fraction;
        /// <summary>Volume fraction at the greatest parameter that the kind of structure allows.</summary>
        public double max_fraction;
    }

    /// <summary>Definition of contours. The plane is normal to an axis. Its coordinates u, v are the other two axes in their order: x, y for axis z; x, z for axis y; y, z for axis x.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_contours_def
    {
        public uint struct_size;
        /// <summary>Type of the coordinates: MSQ_INT32, MSQ_INT64 or MSQ_FLOAT64 (default).</summary>
        public int type;
        /// <summary>Normal of the plane: 0 (x), 1 (y) or 2 (z, default).</summary>
        public int axis;
        /// <summary>0 (default): the bounding box of the model; window_min and window_max must be 0. 1: the window below.</summary>
        public int has_window;
        /// <summary>Corners in u and v, in model units. Rings close along the edges of the window. Two windows that have a whole edge in common, with the same other values of this struct, have the same points on that edge, bit for bit.</summary>
        public fixed double window_min[2];
        public fixed double window_max[2];
        /// <summary>Maximum distance between boundary and rings, in model units, where features are wider than the pitch. Positive; there is no default.</summary>
        public double tolerance;
        /// <summary>Distance between the nodes at which the model is sampled. Rounded down to three binary digits. Parts of the solid or of the void that contain a disc of diameter sqrt(2) * pitch are never lost; narrower ones may be. If the tolerance is at most pitch / 8, a gap that becomes narrower than the pitch is followed until it is about as narrow as the tolerance, or as pitch / 16 if that is more (docs/concepts.md). 0 (default): the tolerance. Up to 2^18 times each side of the window.</summary>
        public double pitch;
        /// <summary>Coordinates are model coordinates times this. Default 1. Integer coordinates are rounded to the nearest integer. The pitch must then be at least 64 units, and the tolerance at least 4.</summary>
        public double units;
        /// <summary>As in msq_query_def. msq_slicer_contours takes that of the slicer, and this must be 0.</summary>
        public double length_scale;
        /// <summary>0 (default): topology_count of the report is not computed. Otherwise 2, 4, 8 or 16: the rings are compared with a mask of that many samples along each side of the grid's cells. This does not change the rings. Costs about as much as the bits of that mask; memory: a band of its rows.</summary>
        public uint topology_samples;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_contours_def Defaults()
        {
            msq_contours_def made;
            MsqException.Check(Abi.msq_contours_def_init(&made, (UIntPtr)sizeof(msq_contours_def)));
            return made;
        }
    }

    /// <summary>Definition of one of the outputs of a slicer.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_output_def
    {
        public uint struct_size;
        /// <summary>An msq_layer_output. Default MSQ_LAYER_BITS.</summary>
        public int output;
        /// <summary>GREY: as in msq_slicer_def. Defaults 4, 0 and 1.</summary>
        public uint grey_samples;
        public uint grey_threshold;
        public double grey_gamma;
        /// <summary>ONSET: the scale of the structure, from 1. It must be resolved. 0 (default): the finest resolved scale.</summary>
        public uint onset_scale;
        /// <summary>ONSET: an msq_onset_value. Default MSQ_ONSET_PLAIN.</summary>
        public int onset_value;
        /// <summary>CONTOURS: as msq_slicer_contours takes it. Copied. Other outputs: NULL (default).</summary>
        public msq_contours_def* contours;
        /// <summary>CHANNEL: its name, in UTF-8, copied. A material of a resolved scale must have it. Other outputs: NULL (default).</summary>
        public byte* channel;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_output_def Defaults()
        {
            msq_output_def made;
            MsqException.Check(Abi.msq_output_def_init(&made, (UIntPtr)sizeof(msq_output_def)));
            return made;
        }
    }

    /// <summary>Definition of a slicer.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_slicer_def
    {
        public uint struct_size;
        /// <summary>An msq_layer_output except CONTOURS and CHANNEL. Default MSQ_LAYER_BITS. If outputs are given it must be the default.</summary>
        public int output;
        /// <summary>Pixel size in x and y. 0 (default): from region and resolution.</summary>
        public fixed double pitch[2];
        /// <summary>Pixels in x and y. 0 (default): from region and pitch, rounded up.</summary>
        public fixed uint resolution[2];
        /// <summary>Positive, unless layer_z is given.</summary>
        public double layer_height;
        /// <summary>0 (default): from region and layer_height, rounded up.</summary>
        public ulong layer_count;
        /// <summary>0 (default): the region is the bounding box of the model, centred in the pixels; region_min and region_max must be 0. 1: the region below. A model of all space needs 1.</summary>
        public int has_region;
        /// <summary>Layers computed at once. 0 (default): about 64 layers in whole cells of the finest scale, at least one. A slab takes at most 32 MiB and a quarter of the context's memory_limit. Some structures do not become faster with more layers; their slabs take at most 2 MiB per thread. A run computes fewer layers at once if the memory limit leaves less. The first slab of a run has a 32nd of the layers, so that the host receives its first layer soon; slabs of at most 2 MiB per thread are not divided in this way. If even one layer is too large, bands of its rows are computed one after the other. Does not change results.</summary>
        public uint slab_layers;
        /// <summary>Corner of pixel (0, 0) and bottom of layer 0.</summary>
        public fixed double region_min[3];
        /// <summary>Required where a resolution or layer_count of 0 is computed from it.</summary>
        public fixed double region_max[3];
        /// <summary>z of each layer, strictly ascending. NULL (default): the middle of each layer, region_min[2] + (index + 1/2) * layer_height.</summary>
        public double* layer_z;
        /// <summary>Number of layers in layer_z: 1 to 2^31 - 1.</summary>
        public ulong layer_z_count;
        /// <summary>As in msq_query_def.</summary>
        public double length_scale;
        /// <summary>Pixels and layers that are computed, as an index window of the plan that the fields above make. The slicer then has window.count[2] layers of window.count[0] x window.count[1] pixels, with their own indices from 0. All zeros (default): the whole plan.</summary>
        public msq_window window;
        /// <summary>GREY: samples along each side of a pixel: 2, 4 (default), 8 or 16.</summary>
        public uint grey_samples;
        /// <summary>GREY: smaller values become 0 (minimum exposure). 0 (default) to 255.</summary>
        public uint grey_threshold;
        /// <summary>GREY: 0.1 to 10. Default 1.</summary>
        public double grey_gamma;
        /// <summary>A sum of msq_layer_orientation. Default 0. It turns pixels. Contours keep the coordinates of the model.</summary>
        public uint orientation;
        /// <summary>Number of outputs: 1 to 64. 0 (default) if outputs is NULL.</summary>
        public uint output_count;
        /// <summary>What each layer holds, in place of `output` and the values for GREY above. Copied. All elements have the same struct_size, which is the distance between them. Outputs that sample the same points share their samples: BITS and BYTES, and GREY of equal grey_samples. NULL (default): one output, as above.</summary>
        public msq_output_def* outputs;
        /// <summary>Where layers lie. The point with the coordinates u, v, w is frame_origin + u * axis 0 + v * axis 1 + w * axis 2. Rows of pixels lie along u, one row follows the other along v, and layers lie along w. x, y and z in the text above and of layers then mean u, v and w, also in the region, in heights, in contours and in findings. Default 0.</summary>
        public fixed double frame_origin[3];
        /// <summary>Three rows, the axes, orthonormal within 1e-9; msq takes the nearest axes that are orthonormal. Left-handed axes mirror. All zeros (default): the axes of the model. For layers normal to x whose pixels lie along y and z: {0, 1, 0, 0, 0, 1, 1, 0, 0}. Cost: bits of layers normal to y with pixels along x and z cost what they do without a frame. Along other axes they take 10 to 15 ns per sample and thread in a box; more in meshes and host shapes, which evaluate points.</summary>
        public fixed double frame_axes[9];

        /// <summary>One with the defaults of msq.</summary>
        public static msq_slicer_def Defaults()
        {
            msq_slicer_def made;
            MsqException.Check(Abi.msq_slicer_def_init(&made, (UIntPtr)sizeof(msq_slicer_def)));
            return made;
        }
    }

    /// <summary>The plan of a slicer.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_slicer_report
    {
        public uint struct_size;
        /// <summary>Layers computed at once, except in the first slab of a run.</summary>
        public uint slab_layers;
        /// <summary>Pixels in x and y of the layers that the host receives: exchanged with TRANSPOSE.</summary>
        public uint width;
        /// <summary>Pixels in x and y of the layers that the host receives: exchanged with TRANSPOSE.</summary>
        public uint height;
        public ulong layer_count;
        /// <summary>Bytes from one row to the next, a multiple of 8. Of the first output; CONTOURS: 0.</summary>
        public ulong stride;
        /// <summary>stride * height.</summary>
        public ulong layer_bytes;
        /// <summary>x, y of the centre of pixel (0, 0) of the whole plan.</summary>
        public fixed double origin[2];
        /// <summary>Pixel (i, j) is sampled at origin + (i, j) * pitch, as in a grid of points. With a window: at origin + (window.first + (i, j)) * pitch.</summary>
        public fixed double pitch[2];
        /// <summary>The window. Without one: the whole plan.</summary>
        public msq_window window;
        /// <summary>Pixels in x and y, and layers, of the whole plan.</summary>
        public fixed ulong whole[3];
    }

    /// <summary>What one of the outputs is in a layer. Valid until the callback returns.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_output
    {
        /// <summary>Out: sizeof(msq_output) of the library.</summary>
        public uint struct_size;
        /// <summary>An msq_layer_output.</summary>
        public int output;
        /// <summary>height rows, row 0 at the smallest y. Bits past the width are 0. CONTOURS: NULL.</summary>
        public byte* data;
        /// <summary>Bytes from one row to the next. CONTOURS: 0.</summary>
        public ulong stride;
        /// <summary>Number of pixels inside. GREY: number of samples inside. ONSET, CONTOURS: 0.</summary>
        public ulong inside_count;
        /// <summary>CONTOURS: the rings of the layer, for msq_contours_info. To keep them beyond the callback, retain them. Other outputs: NULL.</summary>
        public msq_contours* contours;
    }

    /// <summary>One layer. Valid until the callback returns.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_layer
    {
        /// <summary>Out: sizeof(msq_layer) of the library.</summary>
        public uint struct_size;
        /// <summary>The output, data, stride and inside_count below are those of the first output.</summary>
        public int output;
        /// <summary>Number of the layer, from 0; with a window, from its first layer.</summary>
        public ulong index;
        public double z;
        public byte* data;
        public ulong stride;
        /// <summary>Pixels of all outputs.</summary>
        public uint width;
        /// <summary>Pixels of all outputs.</summary>
        public uint height;
        public ulong inside_count;
        /// <summary>At least 1.</summary>
        public ulong output_count;
        /// <summary>output_count pointers, in the order of msq_slicer_def.outputs.</summary>
        public msq_output** outputs;
    }

    /// <summary>Receives a layer. Return 0 to continue, or the host's code, preferably negative, to stop. Exceptions of the host's language must not leave it.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_layer_fn(void* user, msq_layer* layer);

    /// <summary>The rings of contours. Pointers are valid as long as the contours are.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_contours_report
    {
        public uint struct_size;
        /// <summary>As in the definition.</summary>
        public int type;
        public ulong ring_count;
        /// <summary>Of all rings together. A ring does not repeat its first point.</summary>
        public ulong point_count;
        /// <summary>Pairs u, v of the type.</summary>
        public void* points;
        /// <summary>ring_count + 1 numbers: points starts[i] to starts[i + 1] - 1 are those of ring i.</summary>
        public ulong* starts;
        /// <summary>The ring just around ring i. -1: none. The parent of a hole is an outer ring; that of an outer ring is a hole.</summary>
        public long* parents;
        /// <summary>1: a hole. 0: an outer ring.</summary>
        public byte* holes;
        /// <summary>Places where the rings may be wrong at the scale of the pitch: where one sample decided what is connected, where the boundary is not within the tolerance, and cells that a strut crosses without covering a node. Other features that no node or crossing meets are not counted.</summary>
        public ulong unresolved_count;
        /// <summary>Distance between the nodes, as rounded.</summary>
        public double pitch;
        /// <summary>With topology_samples: an upper bound on the number of parts that must appear, vanish, be cut or be joined until the rings have the topology of a mask with topology_samples samples per pitch. The numbers of outer rings and of parts of the mask differ by no more, nor do those of holes and of enclosed parts of the void. 0: both have the same topology. Features that the mask does not show are not counted. 0 without topology_samples.</summary>
        public ulong topology_count;
        /// <summary>As in the definition.</summary>
        public uint topology_samples;
    }

    /// <summary>Selects findings.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_printability_def
    {
        public uint struct_size;
        /// <summary>A sum of msq_finding_kind. Default ISLAND + LOOSE + VOID.</summary>
        public uint kinds;
        /// <summary>1 (default): the first layer lies on a build plate, which carries it and closes voids. 0: there is nothing below.</summary>
        public int has_plate;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        /// <summary>THIN: the width in model units, 2 to 32 pixels along x and y. Otherwise 0 (default).</summary>
        public double width;
        /// <summary>Findings of less volume are ignored. In model units cubed, at least 0. Default 0.</summary>
        public double min_volume;
        /// <summary>OVERHANG: the distance in model units, 0 (default) to 31 pixels along x and y. Solid that leans by an angle reaches layer_height * tan(angle) beyond the layer below. Otherwise 0.</summary>
        public double overhang;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_printability_def Defaults()
        {
            msq_printability_def made;
            MsqException.Check(Abi.msq_printability_def_init(&made, (UIntPtr)sizeof(msq_printability_def)));
            return made;
        }
    }

    /// <summary>A possible problem in printing. A sample represents the box of a pixel and its layer's height, which reaches half-way to the layers around it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_finding
    {
        /// <summary>An msq_finding_kind.</summary>
        public int kind;
        public uint reserved;
        /// <summary>Layers of the slicer, the first and the last one that it has samples in.</summary>
        public ulong first_layer;
        public ulong last_layer;
        public ulong sample_count;
        /// <summary>In model units cubed. Of an island: in its layer.</summary>
        public double volume;
        /// <summary>One of its samples, in model units: of its first layer, at the lowest y and there at the lowest x.</summary>
        public fixed double point[3];
        /// <summary>Box around its samples, in model units.</summary>
        public fixed double min[3];
        /// <summary>Box around its samples, in model units.</summary>
        public fixed double max[3];
    }

    /// <summary>Receives findings, at most 4096 at a time, valid until it returns. Return 0 to continue, or the host's code, preferably negative, to stop. Exceptions of the host's language must not leave it.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_findings_fn(void* user, msq_finding* findings, ulong count);

    /// <summary>Totals of what was found. Volumes are in model units cubed.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_printability_report
    {
        public uint struct_size;
        public uint reserved;
        /// <summary>Layers that were inspected.</summary>
        public ulong layer_count;
        /// <summary>Solid samples, and their volume.</summary>
        public ulong solid_count;
        public double solid_volume;
        /// <summary>Findings of each kind. 0 for kinds that were not looked for.</summary>
        public ulong island_count;
        /// <summary>Findings of each kind. 0 for kinds that were not looked for.</summary>
        public ulong loose_count;
        /// <summary>Findings of each kind. 0 for kinds that were not looked for.</summary>
        public ulong void_count;
        /// <summary>Findings of each kind. 0 for kinds that were not looked for.</summary>
        public ulong thin_count;
        public double island_volume;
        public double loose_volume;
        public double void_volume;
        public double thin_volume;
        public ulong cup_count;
        public ulong overhang_count;
        public double cup_volume;
        public double overhang_volume;
    }

    /// <summary>A ring of a polygon.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_ring
    {
        /// <summary>count pairs x, y of the definition's coordinate_type. The last point is joined to the first. No alignment is needed.</summary>
        public void* points;
        /// <summary>At least 3.</summary>
        public ulong count;
    }

    /// <summary>A polygon with holes at a height, and how it is filled.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_fill_def
    {
        public uint struct_size;
        /// <summary>Type of the coordinates of the rings and of the result: MSQ_INT32 or MSQ_INT64 (default).</summary>
        public int coordinate_type;
        /// <summary>ring_count rings, outlines and holes in any order and direction. Points enclosed by an odd number of rings are filled.</summary>
        public msq_ring* rings;
        public ulong ring_count;
        /// <summary>Bytes from one point of a ring to the next. 0 (default): tightly packed.</summary>
        public ulong point_stride;
        /// <summary>Model units per unit of the coordinates, for example 1e-6 for nanometres in a model in millimetres. No default.</summary>
        public double scale;
        /// <summary>x, y in the model of the coordinates 0, 0. Default 0.</summary>
        public fixed double origin[2];
        /// <summary>In model units. Slicers take the middle of the layer. Default 0.</summary>
        public double z;
        /// <summary>Maximum distance between the lines and the middle of the walls, in model units, before rounding to the coordinates. Less than half a unit of the coordinates gains nothing. 0 (default): 1/200 of the smallest cell size.</summary>
        public double tolerance;
        /// <summary>In model units. Shorter paths are dropped. Shorter lines between two points where an odd number of lines meet are dropped too: each saves a path. If min_length is at most the width of a printed line, the lines that continue at the two ends still touch. Default 0.</summary>
        public double min_length;
        /// <summary>Distance between two lines side by side, in model units, about the width of a line. 0 (default): no wall is printed twice. If it is positive, some walls between points where an odd number of lines meet become two lines side by side. This joins paths, so a printer stops less often and travels less. Such walls are 15 to 25 % of the length of a foam's lines, which grows by as much; msq_fill_calibrate counts each wall once. Shorter walls are chosen first. A wall is not chosen if one of its two lines would leave the polygon. The two lines may cross.</summary>
        public double pair_distance;
        /// <summary>In model units, about the width of a line. If positive, corners of paths are rounded, so that a printer need not slow down as much for them: a parabola of four lines replaces each corner. It begins and ends at most at this distance from the corner, and at most half way to the next point. So no line moves by more than half of this distance, beyond the tolerance. Bends of up to 11 degrees stay, and so do corners whose curve would leave the polygon. The lines of a foam become a few percent shorter, which msq_fill_calibrate does not count. Default 0: no corner is rounded.</summary>
        public double corner_distance;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_fill_def Defaults()
        {
            msq_fill_def made;
            MsqException.Check(Abi.msq_fill_def_init(&made, (UIntPtr)sizeof(msq_fill_def)));
            return made;
        }
    }

    /// <summary>The paths of a fill. The arrays belong to the fill and are valid as long as it is.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_fill_report
    {
        public uint struct_size;
        /// <summary>As in the definition.</summary>
        public int coordinate_type;
        /// <summary>point_count pairs x, y of int32_t or int64_t.</summary>
        public void* points;
        public ulong point_count;
        /// <summary>path_count + 1 numbers: path i has the points path_starts[i] to path_starts[i + 1] - 1.</summary>
        public ulong* path_starts;
        /// <summary>path_count bytes. 1: the last point is joined to the first; 0: it is not.</summary>
        public byte* closed;
        public ulong path_count;
        /// <summary>Length of all paths in model units.</summary>
        public double length;
        /// <summary>Length of the straight moves from each path to the next, in model units.</summary>
        public double travel;
    }

    /// <summary>Definition of a mesh.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_surface_def
    {
        public uint struct_size;
        /// <summary>0 (default): the bounding box of the model; min and max must be 0. 1: the box below. A model of all space needs 1.</summary>
        public int has_box;
        /// <summary>Corners of the box, in model units. The mesh is closed where its faces cut the model.</summary>
        public fixed double min[3];
        public fixed double max[3];
        /// <summary>Distance between the nodes at which the model is sampled, in model units. Positive; there is no default. Walls and struts narrower than sqrt(3) * pitch may break or be lost.</summary>
        public double pitch;
        /// <summary>As in msq_query_def.</summary>
        public double length_scale;
        /// <summary>Layers of nodes per callback, at most. 0 (default): as many as fit 32 MiB of nodes and about 2^18 crossings. Does not change the mesh.</summary>
        public uint slab_layers;
        /// <summary>Must be 0.</summary>
        public uint reserved;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_surface_def Defaults()
        {
            msq_surface_def made;
            MsqException.Check(Abi.msq_surface_def_init(&made, (UIntPtr)sizeof(msq_surface_def)));
            return made;
        }
    }

    /// <summary>A part of a mesh. The arrays are valid until the callback returns. The parts in sequence are the mesh.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_surface_slab
    {
        /// <summary>Out: sizeof(msq_surface_slab) of the library.</summary>
        public uint struct_size;
        public uint reserved;
        /// <summary>Number of vertices in the parts before this one.</summary>
        public ulong first_vertex;
        public ulong vertex_count;
        /// <summary>vertex_count triples x, y, z.</summary>
        public double* vertices;
        /// <summary>vertex_count triples: outward, of length 1. The normal of the surface at the vertex, as in msq_ray_hit; on an edge, that of one of its sides or their mean.</summary>
        public float* normals;
        /// <summary>Number of triangles in the parts before this one.</summary>
        public ulong first_triangle;
        public ulong triangle_count;
        /// <summary>triangle_count triples of vertices, counter-clockwise seen from outside. Vertices are numbered through the whole mesh: a triangle has vertices of this part or of parts before it.</summary>
        public uint* triangles;
    }

    /// <summary>Receives a part of a mesh. Return 0 to continue, or the host's code, preferably negative, to stop. Exceptions of the host's language must not leave it.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_surface_fn(void* user, msq_surface_slab* slab);

    /// <summary>Some bytes of a file. Valid until the callback returns.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_file_part
    {
        /// <summary>Out: sizeof(msq_file_part) of the library.</summary>
        public uint struct_size;
        public uint reserved;
        /// <summary>Where the bytes belong in the file.</summary>
        public ulong offset;
        /// <summary>Number of bytes, at least 1.</summary>
        public ulong size;
        /// <summary>Size of the whole file, the same in all parts.</summary>
        public ulong total;
        public byte* bytes;
    }

    /// <summary>Receives some bytes of a file. Return 0 to continue, or the host's code, preferably negative, to stop. Exceptions of the host's language must not leave it.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_file_fn(void* user, msq_file_part* part);

    /// <summary>An array of rays: origin + t * direction.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_rays_def
    {
        public uint struct_size;
        /// <summary>Of origins and directions: MSQ_FLOAT32 or MSQ_FLOAT64 (default).</summary>
        public int coordinate_type;
        public ulong count;
        /// <summary>count triples x, y, z.</summary>
        public void* origins;
        /// <summary>count triples, of any length except 0.</summary>
        public void* directions;
        /// <summary>Bytes from one origin to the next. 0 (default): tightly packed.</summary>
        public ulong origin_stride;
        /// <summary>Bytes from one direction to the next. 0 (default): tightly packed.</summary>
        public ulong direction_stride;
        /// <summary>count numbers. NULL (default): 0.</summary>
        public double* t_min;
        /// <summary>count numbers, may be infinity. NULL (default): infinity. A model of all space needs finite ones.</summary>
        public double* t_max;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_rays_def Defaults()
        {
            msq_rays_def made;
            MsqException.Check(Abi.msq_rays_def_init(&made, (UIntPtr)sizeof(msq_rays_def)));
            return made;
        }
    }

    /// <summary>Where a ray first meets the solid.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_ray_hit
    {
        /// <summary>The point is origin + t * direction. Infinity: no hit.</summary>
        public double t;
        /// <summary>Outward, of length 1. Against the ray if it starts inside. 0 without a hit.</summary>
        public fixed double normal[3];
        /// <summary>Scale whose surface was hit; 0: the coarse shape; -1: no hit.</summary>
        public int scale;
        /// <summary>1: the ray is inside at t_min; t is t_min and scale is the finest one.</summary>
        public int starts_inside;
        /// <summary>Cell of the finest resolved structure at the point; 0 for beams, which have no cells.</summary>
        public fixed int cell[3];
        /// <summary>Material id just inside. MSQ_MATERIAL_VOID without a hit, or if no resolved scale has a material.</summary>
        public uint material;
    }

    /// <summary>A camera. It looks from eye to target, which is the middle of the picture. Depth is the distance from the plane through eye normal to that direction. docs/concepts.md has the formulas.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_camera
    {
        public uint struct_size;
        /// <summary>An msq_projection. Default MSQ_CAMERA_ORTHOGRAPHIC.</summary>
        public int projection;
        /// <summary>PERSPECTIVE: origin of all rays. ORTHOGRAPHIC: a point of the plane of their origins. No default.</summary>
        public fixed double eye[3];
        /// <summary>Different from eye. No default.</summary>
        public fixed double target[3];
        /// <summary>Upwards in the picture. Not parallel to the view. Default 0, 0, 1.</summary>
        public fixed double up[3];
        /// <summary>ORTHOGRAPHIC: height of the picture in model units. No default.</summary>
        public double height;
        /// <summary>PERSPECTIVE: vertical angle of view in degrees, 0.001 to 179. Default 40.</summary>
        public double field_of_view;
        /// <summary>Depths between which the model is visible; the rest is cut away. 0 &lt;= near &lt; far. Defaults 0 and infinity.</summary>
        public double clip_near;
        /// <summary>Depths between which the model is visible; the rest is cut away. 0 &lt;= near &lt; far. Defaults 0 and infinity.</summary>
        public double clip_far;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_camera Defaults()
        {
            msq_camera made;
            MsqException.Check(Abi.msq_camera_init(&made, (UIntPtr)sizeof(msq_camera)));
            return made;
        }
    }

    /// <summary>How a picture is rendered.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_render_def
    {
        public uint struct_size;
        /// <summary>Size of the whole picture in pixels, 1 to 16384. No default.</summary>
        public uint width;
        /// <summary>Size of the whole picture in pixels, 1 to 16384. No default.</summary>
        public uint height;
        /// <summary>Upper left corner of the tile to render.</summary>
        public uint tile_x;
        /// <summary>Upper left corner of the tile to render.</summary>
        public uint tile_y;
        /// <summary>Size of the tile. All four 0 (default): the whole picture. A tile has exactly the pixels of the whole picture.</summary>
        public uint tile_width;
        /// <summary>Size of the tile. All four 0 (default): the whole picture. A tile has exactly the pixels of the whole picture.</summary>
        public uint tile_height;
        /// <summary>rgba: samples along each side of a pixel, 1 (default) to 16.</summary>
        public uint samples;
        /// <summary>With a callback: 2, 4, ... 64: the first pass casts one ray per square block with this side in pixels; each further pass halves the side. 1 (default): one pass.</summary>
        public uint first_step;
        /// <summary>An msq_colour_by.</summary>
        public int colour_by;
        /// <summary>colour_count triples red, green, blue, linear, 0 to 1. NULL (default): 8 colours of msq.</summary>
        public double* colours;
        /// <summary>1 to 65536.</summary>
        public ulong colour_count;
        /// <summary>Red, green, blue (linear) and opacity where nothing is hit. Default 0.</summary>
        public fixed double background[4];
        /// <summary>Direction to the light in the frame of the camera: right, up, towards the eye. Any length except 0. Default -0.4, 0.6, 1.</summary>
        public fixed double light[3];
        /// <summary>Share of ambient light, 0 to 1. Default 0.3.</summary>
        public double ambient;
        /// <summary>1: a shadow ray per lit sample. Default 0.</summary>
        public int shadows;
        /// <summary>Ambient occlusion rays per sample, 0 (default) to 256, distributed by the cosine with the normal.</summary>
        public uint occlusion_rays;
        /// <summary>Length of occlusion rays in model units. 0 (default): a tenth of the diagonal of the bounding box.</summary>
        public double occlusion_distance;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_render_def Defaults()
        {
            msq_render_def made;
            MsqException.Check(Abi.msq_render_def_init(&made, (UIntPtr)sizeof(msq_render_def)));
            return made;
        }
    }

    /// <summary>Arrays that receive pixels. Pixel (i, j) of the tile, j downwards, has index j * row_pixels + i. Arrays that are NULL are skipped. All arrays except rgba describe the ray through the centre of the pixel.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_frame
    {
        public uint struct_size;
        /// <summary>Pixels from one row to the next. 0 (default): the width of the tile.</summary>
        public uint row_pixels;
        /// <summary>Infinity without a hit.</summary>
        public float* depth;
        /// <summary>3 per pixel, as in msq_ray_hit, in model coordinates. 0 without a hit.</summary>
        public float* normal;
        /// <summary>As in msq_ray_hit. -1 without a hit.</summary>
        public int* scale;
        /// <summary>As in msq_ray_hit.</summary>
        public uint* material;
        /// <summary>4 per pixel: red, green, blue in sRGB, and opacity. Not premultiplied.</summary>
        public byte* rgba;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_frame Defaults()
        {
            msq_frame made;
            MsqException.Check(Abi.msq_frame_init(&made, (UIntPtr)sizeof(msq_frame)));
            return made;
        }
    }

    /// <summary>A pass of a rendering.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_render_pass
    {
        /// <summary>Out: sizeof(msq_render_pass) of the library.</summary>
        public uint struct_size;
        /// <summary>Side in pixels of the blocks that share one ray. 1: each pixel has its own.</summary>
        public uint step;
        /// <summary>rgba: samples along a side of a pixel.</summary>
        public uint samples;
        /// <summary>1: the picture is complete.</summary>
        public int is_last;
    }

    /// <summary>Receives a pass. The frame contains a whole picture, to show or copy; the host must not change it before the last pass. Return 0 to continue, or the host's code, preferably negative, to stop. Exceptions of the host's language must not leave it.</summary>
    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate int msq_render_fn(void* user, msq_render_pass* pass);

    /// <summary>How a document is read. The limits protect the host from hostile documents.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_document_def
    {
        public uint struct_size;
        /// <summary>An msq_document_files. Default MSQ_DOCUMENT_FILES_BELOW.</summary>
        public int files;
        /// <summary>Where relative paths start. NULL (default): msq_document_from_file takes the directory of the document; a document from memory may then name no relative path.</summary>
        public byte* base_directory;
        /// <summary>Maximum size of the document in bytes. 0 and default: 64 MiB.</summary>
        public ulong max_bytes;
        /// <summary>Maximum number of values in the document: numbers, texts, lists and objects. 0 and default: 8 million.</summary>
        public ulong max_values;
        /// <summary>Maximum depth of nested lists and objects, at most 1024. 0 and default: 64.</summary>
        public uint max_depth;
        /// <summary>Maximum number of files that the document names. 0 and default: 256.</summary>
        public uint max_files;
        /// <summary>Maximum size in bytes of all these files together, and of what an archive among them unpacks to. 0 and default: 4 GiB.</summary>
        public ulong max_file_bytes;
        /// <summary>Maximum number of triangles of each mesh file. 0 and default: 200 million.</summary>
        public ulong max_triangles;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_document_def Defaults()
        {
            msq_document_def made;
            MsqException.Check(Abi.msq_document_def_init(&made, (UIntPtr)sizeof(msq_document_def)));
            return made;
        }
    }

    /// <summary>Contents of a document.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_document_report
    {
        public uint struct_size;
        /// <summary>Version of the format that the document names; now 1.</summary>
        public uint version;
        /// <summary>1 if it has settings for slices; 1 if it has settings for pictures.</summary>
        public int has_slicing;
        /// <summary>1 if it has settings for slices; 1 if it has settings for pictures.</summary>
        public int has_view;
        /// <summary>Number of files that it names.</summary>
        public uint files;
        public uint reserved;
        /// <summary>Its title in UTF-8, "" if it has none. Valid as long as the document.</summary>
        public byte* title;
    }

    /// <summary>How a model is written.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct msq_json_def
    {
        public uint struct_size;
        /// <summary>Must be 0.</summary>
        public uint reserved;
        /// <summary>Paths of files below this directory become relative to it. It is compared as text. NULL (default): paths are written as msq_shape_from_file got them. Relative paths of a document have the base_directory of that document before them.</summary>
        public byte* base_directory;
        /// <summary>In UTF-8. NULL (default): none.</summary>
        public byte* title;
        /// <summary>Settings to write beside the model. NULL (default): none. camera and render go together.</summary>
        public msq_slicer_def* slicing;
        public msq_camera* camera;
        public msq_render_def* render;
        /// <summary>Maximum number of values of an array that is written into the document: of the vertices and triangles of a mesh, an image, beams. 0 and default: 1 million.</summary>
        public ulong max_numbers;

        /// <summary>One with the defaults of msq.</summary>
        public static msq_json_def Defaults()
        {
            msq_json_def made;
            MsqException.Check(Abi.msq_json_def_init(&made, (UIntPtr)sizeof(msq_json_def)));
            return made;
        }
    }

    /// <summary>The functions and constants of msq.h.</summary>
    public static unsafe partial class Abi
    {
        public const uint MSQ_VERSION_MAJOR = 0;
        public const uint MSQ_VERSION_MINOR = 2;
        public const uint MSQ_VERSION_PATCH = 0;
        public const uint MSQ_VERSION = 200;
        public const int MSQ_OK = 0;
        public const int MSQ_E_ARGUMENT = -1;
        public const int MSQ_E_MEMORY = -2;
        public const int MSQ_E_CANCELLED = -3;
        public const int MSQ_E_HOST = -4;
        public const int MSQ_E_IO = -5;
        public const int MSQ_E_UNSUPPORTED = -6;
        public const int MSQ_E_MESH = -7;
        public const int MSQ_E_LIMIT = -8;
        public const int MSQ_E_INTERNAL = -9;
        public const int MSQ_CACHE_FIFO = 0;
        public const int MSQ_CACHE_SEGMENTED = 1;
        public const int MSQ_WARNING_OPEN_MESH = 1;
        public const int MSQ_WARNING_COARSE_PITCH = 2;
        public const int MSQ_WARNING_SMALL_CACHE = 3;
        public const int MSQ_WARNING_UNMATCHED_CELLS = 4;
        public const int MSQ_WINDING_NONZERO = 0;
        public const int MSQ_WINDING_EVEN_ODD = 1;
        public const int MSQ_WINDING_POSITIVE = 2;
        public const int MSQ_WINDING_AUTO = 3;
        public const int MSQ_FLOAT32 = 1;
        public const int MSQ_FLOAT64 = 2;
        public const int MSQ_UINT8 = 3;
        public const int MSQ_INT16 = 4;
        public const int MSQ_UINT16 = 5;
        public const int MSQ_INT32 = 6;
        public const int MSQ_INT64 = 7;
        public const int MSQ_FORMAT_AUTO = 0;
        public const int MSQ_FORMAT_STL = 1;
        public const int MSQ_FORMAT_OBJ = 2;
        public const int MSQ_FORMAT_PLY = 3;
        public const int MSQ_FORMAT_OFF = 4;
        public const int MSQ_FORMAT_3MF = 5;
        public const int MSQ_FORMAT_AMF = 6;
        public const int MSQ_FORMAT_GLTF = 7;
        public const int MSQ_WARP_CYLINDRICAL = 1;
        public const int MSQ_WARP_SPHERICAL = 2;
        public const int MSQ_WARP_SAMPLED = 3;
        public const int MSQ_SOLID_ABOVE = 0;
        public const int MSQ_SOLID_BELOW = 1;
        public const int MSQ_BOOLEAN_UNION = 1;
        public const int MSQ_BOOLEAN_INTERSECTION = 2;
        public const int MSQ_BOOLEAN_DIFFERENCE = 3;
        public const int MSQ_UNIT_CELL_CUSTOM = 0;
        public const int MSQ_UNIT_CELL_CUBIC = 1;
        public const int MSQ_UNIT_CELL_BCC = 2;
        public const int MSQ_UNIT_CELL_OCTET = 3;
        public const int MSQ_UNIT_CELL_FCC = 4;
        public const int MSQ_UNIT_CELL_KELVIN = 5;
        public const int MSQ_UNIT_CELL_DIAMOND = 6;
        public const int MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON = 7;
        public const int MSQ_UNIT_CELL_REENTRANT = 8;
        public const int MSQ_PLATE_CELL_CUSTOM = 0;
        public const int MSQ_PLATE_CELL_CUBIC = 1;
        public const int MSQ_PLATE_CELL_BCC = 2;
        public const int MSQ_PLATE_CELL_FCC = 3;
        public const int MSQ_PLATE_CELL_CUBIC_OCTET = 4;
        public const int MSQ_PLATE_CELL_KELVIN = 5;
        public const int MSQ_FOAM_AUTO = 0;
        public const int MSQ_FOAM_POINT = 1;
        public const int MSQ_FOAM_METHOD_2 = 2;
        public const int MSQ_FOAM_DIRECT = 3;
        public const int MSQ_FOAM_METHOD_1 = 4;
        public const int MSQ_FUNCTION_EXPRESSION = 0;
        public const int MSQ_FUNCTION_GYROID = 1;
        public const int MSQ_FUNCTION_SCHWARZ_P = 2;
        public const int MSQ_FUNCTION_DIAMOND = 3;
        public const int MSQ_FUNCTION_I_WP = 4;
        public const int MSQ_FUNCTION_NEOVIUS = 5;
        public const int MSQ_FUNCTION_F_RD = 6;
        public const int MSQ_FUNCTION_LIDINOID = 7;
        public const int MSQ_FUNCTION_SPLIT_P = 8;
        public const int MSQ_FUNCTION_FISCHER_KOCH_S = 9;
        public const int MSQ_FUNCTION_C_Y = 10;
        public const int MSQ_FUNCTION_C_PLUS_MINUS_Y = 11;
        public const int MSQ_FUNCTION_KARCHER_K = 12;
        public const int MSQ_FUNCTION_G_PRIME = 13;
        public const int MSQ_FUNCTION_DOUBLE_GYROID = 14;
        public const int MSQ_FUNCTION_DOUBLE_DIAMOND = 15;
        public const int MSQ_FUNCTION_DOUBLE_P = 16;
        public const int MSQ_FUNCTION_HONEYCOMB = 17;
        public const int MSQ_FUNCTION_RODS = 18;
        public const int MSQ_FUNCTIONAL_NETWORK = 1;
        public const int MSQ_FUNCTIONAL_SHEET = 2;
        public const int MSQ_CAP_SPHERE = 0;
        public const int MSQ_CAP_HEMISPHERE = 1;
        public const int MSQ_CAP_BUTT = 2;
        public const int MSQ_CLIPPING_NONE = 0;
        public const int MSQ_CLIPPING_INSIDE = 1;
        public const int MSQ_CLIPPING_OUTSIDE = 2;
        public const int MSQ_BEAM_FILE_SOLID = 0;
        public const int MSQ_BEAM_FILE_CLIPPING = 1;
        public const int MSQ_BOX_MIXED = 0;
        public const int MSQ_BOX_OUTSIDE = 1;
        public const int MSQ_BOX_INSIDE = 2;
        public const int MSQ_STRUTS_OWNED = 0;
        public const int MSQ_STRUTS_NEAR = 1;
        public const int MSQ_MATERIAL_VOID = 0;
        public const int MSQ_QUERY_AUTO = 0;
        public const int MSQ_QUERY_POINT = 1;
        public const int MSQ_QUERY_SET = 2;
        public const int MSQ_POINTS_ARRAY = 1;
        public const int MSQ_POINTS_GRID = 2;
        public const int MSQ_POINTS_STRATIFIED = 3;
        public const int MSQ_ONSET_PLAIN = 0;
        public const int MSQ_ONSET_SIGNED = 1;
        public const int MSQ_PHASE_SOLID = 1;
        public const int MSQ_PHASE_VOID = 2;
        public const int MSQ_LAYER_BITS = 1;
        public const int MSQ_LAYER_BYTES = 2;
        public const int MSQ_LAYER_GREY = 3;
        public const int MSQ_LAYER_DISTANCE = 4;
        public const int MSQ_LAYER_MATERIAL = 5;
        public const int MSQ_LAYER_ONSET = 6;
        public const int MSQ_LAYER_CONTOURS = 7;
        public const int MSQ_LAYER_CHANNEL = 8;
        public const int MSQ_LAYER_MIRROR_X = 1;
        public const int MSQ_LAYER_MIRROR_Y = 2;
        public const int MSQ_LAYER_TRANSPOSE = 4;
        public const int MSQ_FINDING_ISLAND = 1;
        public const int MSQ_FINDING_LOOSE = 2;
        public const int MSQ_FINDING_VOID = 4;
        public const int MSQ_FINDING_THIN = 8;
        public const int MSQ_FINDING_CUP = 16;
        public const int MSQ_FINDING_OVERHANG = 32;
        public const int MSQ_SURFACE_STL = 1;
        public const int MSQ_SURFACE_PLY = 2;
        public const int MSQ_CAMERA_ORTHOGRAPHIC = 0;
        public const int MSQ_CAMERA_PERSPECTIVE = 1;
        public const int MSQ_COLOUR_PLAIN = 0;
        public const int MSQ_COLOUR_SCALE = 1;
        public const int MSQ_COLOUR_MATERIAL = 2;
        public const int MSQ_COLOUR_NORMAL = 3;
        public const int MSQ_DOCUMENT_FILES_BELOW = 0;
        public const int MSQ_DOCUMENT_FILES_NONE = 1;
        public const int MSQ_DOCUMENT_FILES_ANY = 2;

        /// <summary>Returns the version of the loaded library, in the form of MSQ_VERSION.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        uint msq_version();

        /// <summary>Returns the name of a status, for example "MSQ_E_LIMIT"; "MSQ_E_UNKNOWN" for other values. The string is static.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        byte* msq_status_name(int status);

        /// <summary>Returns the message of the last failure on the calling thread, one line in UTF-8; "" before the first failure. The string is valid until the next failure on this thread.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        byte* msq_error_message();

        /// <summary>Returns the code that a host callback returned at the last MSQ_E_HOST on the calling thread; 0 before the first one.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_error_host_code();

        /// <summary>Reports how the loaded library was built. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_build_info(msq_build_report* report);

        /// <summary>Sets the defaults. size: sizeof of the caller's struct. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_context_def_init(msq_context_def* def, UIntPtr size);

        /// <summary>Creates a context. def NULL: defaults. Results never depend on the context. No thread is started before the first call that needs one. Errors: ARGUMENT, MEMORY. Calls that use a context with parallel_for: HOST.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_context_create(msq_context_def* def, msq_context** context);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_context_retain(msq_context* context);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_context_release(msq_context* context);

        /// <summary>Reports the memory accounted to the context. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_context_memory(msq_context* context, msq_memory_report* report);

        /// <summary>Reports the counters of the cell cache since the context was created.</summary>
        /// <remarks>
        /// <para>Before a cell is built, msq reserves the size that recent cells of the structure had. A cell that turns out larger is counted in full from then on. Not counted: working memory of builders, unkept cells, and cells in use that msq_cache_clear or the memory limit dropped. Errors: ARGUMENT. Source: paper, section "Set Queries for Ray-Casting" (FIFO cache).</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_cache_stats(msq_context* context, msq_cache_report* report);

        /// <summary>Drops all cached cells. Running calls keep the cells that they use. The counters remain. The cells of a structure are also dropped when its last reference goes. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_cache_clear(msq_context* context);

        /// <summary>Creates a job. Pass it to one long call at a time; two calls at once mix their progress. Errors: ARGUMENT, MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_job_create(msq_job** job);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_job_retain(msq_job* job);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_job_release(msq_job* job);

        /// <summary>Cancels the call that runs under the job. The call returns MSQ_E_CANCELLED, usually within tens of milliseconds. The job stays cancelled: later calls under it return at once. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_job_cancel(msq_job* job);

        /// <summary>Returns the completed fraction, 0 to 1, of the last call under the job. It is 1 only after success. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_job_progress(msq_job* job, double* fraction);

        /// <summary>Reports the counters of the last set query or statistic under the job; zeros for other calls. Errors: ARGUMENT. Source: paper, section "Structured and Unstructured Set Queries" (critical number of points).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_job_info(msq_job* job, msq_job_report* report);

        /// <summary>Moves a grid along with a part: *placed receives the grid transformed by a matrix as in msq_shape_placed. Seeds and unit cells move with the cells. So a structure on the new grid is the same structure at another place, if the host scales its radius or thickness by the same factor. The host moves fields and beams itself. Without this call a structure stays fixed to the model's frame. The matrix may rotate, translate and scale uniformly. Errors: ARGUMENT (also a matrix that mirrors, shears or stretches by more than 1e-9).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_neighbourhood_placed(msq_neighbourhood* grid, double* matrix, msq_neighbourhood* placed);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_period_def_init(msq_period_def* def, UIntPtr size);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_warp_def_init(msq_warp_def* def, UIntPtr size);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_file_def_init(msq_file_def* def, UIntPtr size);

        /// <summary>Reads a triangle mesh from a file. def NULL: defaults. job NULL: no job. On Windows `path` is UTF-8; other systems receive its bytes unchanged.</summary>
        /// <remarks>
        /// <para>All instances in the file become one shape in millimetres. msq applies transforms, triangulates polygons, welds equal vertices, and drops triangles with fewer than three distinct vertices. It opens no other file. Text is ASCII or UTF-8. A number in text becomes the nearest double. OBJ: vertices and faces are read. glTF: the triangles of the default scene are read from buffers in the file, and the transforms of nodes are applied; y, which is up in glTF, becomes z. Cost: linear in the size of the file (a million triangles: about a second). Cancelling ends the call within tens of milliseconds, except while the XML of 3MF or AMF is parsed. Errors: ARGUMENT, IO (missing, truncated or malformed file; for OBJ and ASCII STL the message names the line), UNSUPPORTED (format; text in UTF-16; binary STL, 3MF or AMF in a build without Assimp, glTF in one without JSON; a 3MF file with beam lattices, see msq_beam_file_open; glTF with buffers in other files, compressed or sparse data, or skins), MESH (no triangles, index out of range, coordinate that is not finite or above 1e100 in millimetres), LIMIT, MEMORY, CANCELLED.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_from_file(msq_context* context, byte* path, msq_file_def* def, msq_shape** shape, msq_job* job);

        /// <summary>Reads a triangle mesh from bytes in memory. def must name the format and must not be NULL. See msq_shape_from_file.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_from_memory(msq_context* context, void* data, ulong bytes, msq_file_def* def, msq_shape** shape, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_mesh_def_init(msq_mesh_def* def, UIntPtr size);

        /// <summary>Creates a shape from a triangle mesh. Dirty meshes (open, self-intersecting, flipped or duplicate triangles) are accepted; msq_shape_info diagnoses them.</summary>
        /// <remarks>
        /// <para>Membership. A point in the bounding box of the mesh is inside if the winding number of the ray from it along +x satisfies the winding rule. Crossings are half-open in y and z, so shared edges and vertices count once. They are closed in x: a point on a crossing is inside if either side is. Points exactly on a face that is highest in y or z are therefore outside; points on the opposite face are inside. On faces that are not normal to an axis the position of the crossing is rounded, by about 1e-16 of the coordinates.</para>
        /// <para>With MSQ_WINDING_AUTO a mesh that is not closed (msq_shape_report.closed is 0) uses the generalised winding number, rounded half up to a whole number. The solid ends at the bounding box. Distances are lower bounds. A skin follows the triangles, not the holes. Additional cost: about 500 bytes per open edge. A point near a hole, or where the winding number is near a half, may take a sum over all open edges.</para>
        /// <para>Limit: 2^32 - 1 vertices and triangles. Cost: linear in the number of triangles; msq keeps about 75 bytes per triangle and needs 100 during construction. Errors: ARGUMENT, MESH (no triangles, index out of range, coordinate that is not finite or above 1e100), LIMIT, MEMORY. Source: Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding numbers", 2013.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_from_mesh(msq_context* context, msq_mesh_def* def, msq_shape** shape);

        /// <summary>Creates an axis-aligned box with its boundary. Coordinates of min, and sides: up to 1e75. Errors: ARGUMENT unless min &lt; max along each axis; MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_from_box(msq_context* context, double* min, double* max, msq_shape** shape);

        /// <summary>Creates a ball with its boundary. Coordinates and radius: up to 1e75. Errors: ARGUMENT unless radius &gt; 0; MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_from_sphere(msq_context* context, double* center, double radius, msq_shape** shape);

        /// <summary>Creates a round cylinder with flat ends and its boundary. Coordinates, their differences and the radius: up to 1e75. Errors: ARGUMENT unless from and to differ and radius &gt; 0; MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_from_cylinder(msq_context* context, double* from, double* to, double radius, msq_shape** shape);

        /// <summary>Creates the shape that contains every point, for structures that the host clips itself. Its bounds and its volume are infinite. It has no surface, so no scale can leave a skin in it, and msq_field_shape_distance refuses it.</summary>
        /// <remarks>
        /// <para>A model of all space is queried like any other, with these differences. The limits of 2^24 cells from the origin of a structure's grid and of 1e75 for coordinates apply to the points of each query. A query beyond them fails with LIMIT and writes nothing. A slicer needs a region, and contours need a window. Rays need a finite t_max. Pictures need a finite clip_far, no shadows, and an occlusion_distance if they have occlusion rays; no camera fits the model. Where no structure is resolved, distances are -1.8e308. Errors: ARGUMENT, MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_all_space(msq_context* context, msq_shape** shape);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_host_shape_def_init(msq_host_shape_def* def, UIntPtr size);

        /// <summary>Creates a shape from callbacks. It has no depth, so no scale can leave a skin in it. Slices and arrays call back with batches of points, distances with single points. def must not be NULL. Errors: ARGUMENT unless min &lt; max along each axis; MEMORY. Calls that use the shape: HOST.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_from_host(msq_context* context, msq_host_shape_def* def, msq_shape** shape);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_voxels_def_init(msq_voxels_def* def, UIntPtr size);

        /// <summary>Creates a shape from a voxel image, for example a CT scan: the points where the trilinear function is on the solid side of the threshold, inside the box that the outermost values span. def must not be NULL. It has no depth, so no scale can leave a skin in it. Limits: coordinates of the origin, and the sum of the extents along the axes, up to 1e75. Cost: linear in the number of values, on the calling thread (one or two seconds for 10^8). Rows and layers then visit the cells that the surface crosses. Errors: ARGUMENT (also if no value is solid), LIMIT (memory limit of the context), MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_from_voxels(msq_context* context, msq_voxels_def* def, msq_shape** shape);

        /// <summary>Creates a shape from another one by an affine map, for example an instance of a part on a plate. The two share mesh, image and trees. matrix: three rows of four numbers, row-major; a point q of the original is placed at matrix * (q, 1). Rotations, scalings, mirror images and shears are allowed.</summary>
        /// <remarks>
        /// <para>A point p is inside if the original contains B * (p - b). b is the last column. B is the inverse of the first three columns, A, computed once in double precision. Skeel's condition is the greatest row sum of |A| |B|. Scaling along an axis does not change it; shears and oblique axes do. Lengths keep the unit of the model. If the map scales all directions alike (within 1e-6), distance and depth are those of the original, scaled. Otherwise the distance is at least the original's times the smallest scale of a direction, and the shape has no depth, so no scale can leave a skin in it: transform the vertices of a mesh instead. Bounds enclose the placed bounding box of the original.</para>
        /// <para>Cost: constant. Points and rays cost what they cost in the original. Layers of a closed mesh cost up to twice those of the original; the first one places a copy of its vertices and triangles, which counts against the memory limit. Layers of other shapes evaluate the distance at a few samples per sample of the outline, which costs tens of times as much as an unplaced mesh. Errors: ARGUMENT (numbers that are not finite; a singular matrix, or one with Skeel's condition above 1e6; lengths that grow or shrink by more than 1e75; coordinates above 1e75), LIMIT (more than 64 shapes made of shapes within each other), UNSUPPORTED (all space), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_placed(msq_shape* original, double* matrix, msq_shape** shape);

        /// <summary>Creates the union, intersection or difference of shapes (operation: an msq_boolean_operation) from their memberships. shapes: count shapes, 1 to 4096.</summary>
        /// <remarks>
        /// <para>Distance of a union: the smallest of the shapes' signed distances, exact outside if theirs are, a bound inside. Of an intersection: the largest, exact inside, a bound outside. Of a difference: that of the intersection with complements. Two kinds have depth, so scales can leave a skin in them: intersections and differences of shapes with depth and exact distances, and unions of shapes with depth whose bounding boxes do not meet. Volume and area are NaN. Cost: the sum of the shapes'. Errors: ARGUMENT (also an intersection of shapes whose bounding boxes do not meet), LIMIT (as msq_shape_placed; more than 4096 shapes in all, counted with repetition), UNSUPPORTED (all space), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_boolean(int operation, msq_shape** shapes, ulong count, msq_shape** shape);

        /// <summary>Creates a shape from another one by moving its surface by a distance, outwards if it is positive and inwards if it is negative: the points whose signed distance to the original (msq_point_distance) is at most distance. Outwards, edges become round.</summary>
        /// <remarks>
        /// <para>The original's distance must be exact on the side to which the surface moves. It is exact for primitives and closed meshes, also if placed with a uniform scale; outwards for unions of these; inwards for intersections and differences of these; and for offsets that are moved again to the same side. Triangles of a mesh that bound nothing count as its surface. The distance of the new shape is exact beyond its surface on that side, a bound on the other. Shapes that are moved inwards have depth if the original has. Cost: a mesh builds its tree at once; then a distance of the original per point. Errors: ARGUMENT (distance 0 or not finite, an offset inwards by more than half the bounding box, coordinates above 1e75), UNSUPPORTED (the distance of the original is a bound on that side; all space), LIMIT (as msq_shape_placed; memory), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_offset(msq_shape* original, double distance, msq_shape** shape);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_shape_retain(msq_shape* shape);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_shape_release(msq_shape* shape);

        /// <summary>Reports bounds, volume, area and the diagnosis of a dirty mesh, as found at construction. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_info(msq_shape* shape, msq_shape_report* report);

        /// <summary>Hashes a shape. The 16 bytes are equal for equal definitions with equal inputs and differ otherwise. With them a host knows whether results that it computed from the shape are still valid.</summary>
        /// <remarks>
        /// <para>They are the same in each run, on each machine, with any number of threads and in all builds of one version of msq. Another version may change them. They do not depend on file names, the context and options whose comment says "Does not change results". They depend on all other fields of a definition. For a mesh these are its vertices and triangles after welding, in their order; for an image its values and their type; for an expression its operations, without spaces and names. 0 and -0 are equal numbers. Shapes, fields, structures and materials within an object contribute their hashes. docs/howto/caching.md has the details.</para>
        /// <para>It is a checksum (XXH3, 128 bits), not a signature: an attacker can make two different objects with the same hash. Cost: the first call reads all inputs once, at some gigabytes per second; the object keeps the result. Errors: ARGUMENT, UNSUPPORTED (an object of the host without a hash_key in it; a build without xxHash), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_hash(msq_shape* shape, byte* hash);

        /// <summary>Counts the pairs of triangles in which a mesh intersects itself. Other shapes: 0.</summary>
        /// <remarks>
        /// <para>A pair counts if its triangles cross, touch, overlap in a plane or are duplicates; a shared vertex or edge alone does not count (CGAL::Polygon_mesh_processing::self_intersections). The decision is exact, after welding, without triangles that have no area. This is a diagnosis: no result of a shape depends on it.</para>
        /// <para>job NULL: no job; progress jumps from 0 to 1 at the end. Cost: about n log^3 n for n triangles plus a test per pair of overlapping boxes, on the calling thread (about a second for 270,000 triangles), with about 100 bytes per triangle. Errors: ARGUMENT, CANCELLED, UNSUPPORTED (a mesh, in a build without CGAL), MEMORY. Source: Zomorodian and Edelsbrunner, "Fast software for box intersections", 2002.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_self_intersections(msq_shape* shape, ulong* pairs, msq_job* job);

        /// <summary>Creates a linear gradient: from_value in the plane through from, to_value in the plane through to, both normal to to - from; linear between the planes and constant beyond them. Errors: ARGUMENT unless from and to are 1e-140 to 1.3e154 apart and the difference of the values is finite; MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_gradient(msq_context* context, double* from, double from_value, double* to, double to_value, msq_field** field);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_radial_field_def_init(msq_radial_field_def* def, UIntPtr size);

        /// <summary>Creates a field that is from_value up to from_radius, to_value from to_radius on, and linear between. def must not be NULL. Errors: ARGUMENT (also if the difference of the values is not finite), MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_radial(msq_context* context, msq_radial_field_def* def, msq_field** field);

        /// <summary>Creates a piecewise linear curve over another field.</summary>
        /// <remarks>
        /// <para>curve: curve_count pairs (value of argument, value of this field), 1 to 65536, strictly ascending in the first component. The curve is constant beyond its ends. Differences of neighbours must be finite. Cost per point: that of argument plus log(curve_count). Errors: ARGUMENT, LIMIT (more than 64 nested maps), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_map(msq_context* context, msq_field* argument, double* curve, ulong curve_count, msq_field** field);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_host_field_def_init(msq_host_field_def* def, UIntPtr size);

        /// <summary>Creates a field from callbacks. def must not be NULL.</summary>
        /// <remarks>
        /// <para>msq decides whole blocks of points by the range over a box. Without range and lipschitz the range is low to high everywhere: correct, but slow. If range or lipschitz are too narrow, results are wrong, but behaviour stays defined. Cost: points and struts call back with one point; sets, and slices of functional structures, of foams and of turned lattices, with batches. Errors: ARGUMENT, MEMORY. Calls that use the field: HOST.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_host(msq_context* context, msq_host_field_def* def, msq_field** field);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_grid_field_def_init(msq_grid_field_def* def, UIntPtr size);

        /// <summary>Creates a field from an image: trilinear between the values; outside the image it has the value of the nearest point of its border. Its Lipschitz constant is that of the steepest pair of neighbours. def must not be NULL. Cost: linear in the number of values, on the calling thread (a second for 10^8); nanoseconds per point. Errors: ARGUMENT, LIMIT (memory limit of the context), MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_grid(msq_context* context, msq_grid_field_def* def, msq_field** field);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_expression_field_def_init(msq_expression_field_def* def, UIntPtr size);

        /// <summary>Creates a field from an expression in x, y and z, clamped to low and high; low where the value is not a number. x, y and z are model coordinates, not angles. def must not be NULL. Rays use a bound of the slope over each box where the expression is smooth. The field has no global Lipschitz constant. Distances to surfaces that depend on it use the slope in boxes around the point, and are 0 where no such slope is known (docs/accuracy.md). Errors: ARGUMENT, LIMIT (as msq_structure_functional), MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_expression(msq_context* context, msq_expression_field_def* def, msq_field** field);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_shape_distance_field_def_init(msq_shape_distance_field_def* def, UIntPtr size);

        /// <summary>Creates a piecewise linear curve over the signed distance to a shape, as msq_point_distance returns it. def must not be NULL. job NULL: no job.</summary>
        /// <remarks>
        /// <para>With a step, msq samples the distance once over the bounding box of the shape and a step around it, on the threads of the context, in single precision. Outside, the field has the value of the nearest point of the border. The error inside is below step * sqrt(3), and far smaller away from edges and medial surfaces. Cost: without a step, that of msq_point_distance per point and strut (microseconds), and the tree of a mesh's triangles, which this call builds; with a step, that of msq_field_grid with 4-byte values. Errors: ARGUMENT (also more than 2^20 steps along an axis, a step below 1.2e-38, and distances that exceed a float), LIMIT (memory limit of the context), UNSUPPORTED (all space), HOST, CANCELLED, MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_shape_distance(msq_context* context, msq_shape_distance_field_def* def, msq_field** field, msq_job* job);

        /// <summary>Hashes a field, as msq_shape_hash does. A field by the distance to a shape that was sampled with a step is hashed from its samples. Errors: as msq_shape_hash.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_hash(msq_field* field, byte* hash);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_field_retain(msq_field* field);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_field_release(msq_field* field);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_unit_cell_def_init(msq_unit_cell_def* def, UIntPtr size);

        /// <summary>Counts the nodes and struts of a unit cell, and finds the nodes on its faces that do not meet a node of the next cell. A cell that is not periodic may be used, but its struts may end at the face.</summary>
        /// <remarks>
        /// <para>unmatched: receives the indices of the unmatched nodes, ascending, at most unmatched_room; NULL if unmatched_room is 0. Nodes within 1e-9 of the cell size are equal. Cost: quadratic in the numbers of nodes and struts, below a second. Errors: ARGUMENT, MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_unit_cell_info(msq_unit_cell_def* cell, msq_unit_cell_report* report, uint* unmatched, ulong unmatched_room);

        /// <summary>Copies the nodes (node_count triples) and struts (strut_count pairs of node indices) of a unit cell, in the order of strut_factors, for example to draw or modify a named cell. The counts must equal those of msq_unit_cell_info. Errors: ARGUMENT, MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_unit_cell_geometry(msq_unit_cell_def* cell, double* nodes, ulong node_count, uint* struts, ulong strut_count);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_lattice_def_init(msq_lattice_def* def, UIntPtr size);

        /// <summary>Creates a periodic strut lattice: all points whose distance to a strut of the tiled unit cell is at most radius times the factor of the strut. def must not be NULL.</summary>
        /// <remarks>
        /// <para>Struts are capsules: circular in model units for any cell size, with round ends, and they reach across cell borders. With a library, each cell has the struts of the unit cell that cell_choice selects. If the nodes of two unlike neighbouring cells do not match (msq_lattice_faces), struts end at the face.</para>
        /// <para>Cost: proportional to the struts that can reach one cell: milliseconds for the named cells, seconds for thousands of struts as wide as cells, and the same again for the first array or distance. With a period or a warp: the struts near a cell are found when the cell is first evaluated, in tens of microseconds, and kept in the cell cache. Errors: ARGUMENT, LIMIT (radius times the greatest factor above 4 times the smallest cell size; cell sizes that differ by more than 2^20 times; library too large; a sampled map of more than 2^24 cells), MEMORY, UNSUPPORTED (both a period and a warp; either of them with a library of several unit cells).</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_lattice(msq_context* context, msq_lattice_def* def, msq_structure** structure);

        /// <summary>Counts the faces between cells of a lattice whose unit cells have nodes there that do not match, and finds the first such face.</summary>
        /// <remarks>
        /// <para>The cells are those with inner points in the box from min to max, in model units (for a model: msq_model_bounds); for a rotated grid, those in the box's bounding box along the axes of the grid. A lattice without a library has no such faces; msq_unit_cell_info returns whether it is periodic. job NULL: no job. Cost: one evaluation of cell_choice per cell, one byte per cell of a layer. Errors: ARGUMENT (also if the structure is not a lattice), CANCELLED, LIMIT (more than 2^30 cells, or 2^24 cells from the origin of the grid), MEMORY, UNSUPPORTED (a lattice with a period or a warp: it has no library).</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_lattice_faces(msq_structure* lattice, double* min, double* max, msq_lattice_faces_report* report, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_plate_lattice_def_init(msq_plate_lattice_def* def, UIntPtr size);

        /// <summary>Creates a periodic lattice of plates: all points whose distance to a triangle of the tiled unit cell is at most half of thickness times the factor of the face. A radius adds the struts of unit_cell, as in msq_structure_lattice on the same grid. def must not be NULL.</summary>
        /// <remarks>
        /// <para>A plate has its thickness in model units for any cell size, has a round rim, and reaches across cell borders. Faces that coincide in several copies count once, with the greatest of their factors. Lattices of plates alone have an onset, which is a thickness. Those with struts have none, so msq_structure_calibrate refuses them.</para>
        /// <para>Cost: proportional to the plates that can reach one cell: milliseconds for the named cells, seconds for thousands of plates as thick as cells, and the same again for the first array, slice or distance. Errors: ARGUMENT, LIMIT (thickness times the greatest factor, or radius times the greatest factor, above 4 times the smallest cell size; cell sizes that differ by more than 2^20 times), MEMORY. Source: Tancogne-Dejean et al. 2018; Berger, Wadley and McMeeking 2017.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_plate_lattice(msq_context* context, msq_plate_lattice_def* def, msq_structure** structure);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_foam_def_init(msq_foam_def* def, UIntPtr size);

        /// <summary>Creates a Voronoi foam of one jittered seed per neighbourhood cell: all points within radius of an edge of the Voronoi diagram, or within half of wall_thickness of a face. def must not be NULL.</summary>
        /// <remarks>
        /// <para>Struts are capsules, circular in model units. Walls are plane; their thickness is measured across the face. Foams with walls alone have an onset, which is a thickness. Those with struts and walls have none, so msq_structure_calibrate refuses them. Seeds are a function of the cell index and the seed number, equal on every machine. Where density exceeds 1, cells are subdivided 2x2x2 recursively. Each leaf has one jittered seed, and the mean number of seeds is the density (docs/concepts.md). Cells are built by the calls that need them. Errors: ARGUMENT, LIMIT (radius, wall_thickness, vent_radius or weight above the smallest cell size; cell sizes that differ by a factor above 4, or in a period or a warp above 16; a warp with 2^15 seeds in a volume of about the largest cell; a sampled map of more than 2^24 cells; stretch, see there; density above 32768), UNSUPPORTED (METHOD_2 without CGAL; walls, a stretch, a weight, a period, a warp, or density above 1, with a method other than AUTO and DIRECT; a stretch, a weight, a period or a warp with density above 1; a stretch or a weight with vent_radius; two of stretch, weight, period and warp), MEMORY. Source: paper, section "Preprocessing for Voronoi Foams"; Martinez, Dumas and Lefebvre 2016. Weights: Imai, Iri and Murota, "Voronoi diagram in the Laguerre geometry and its applications", 1985; Aurenhammer, "Power diagrams: properties, algorithms and applications", 1987; for foams Fan, Wu, Zhao and Lu, "Simulation of polycrystalline structure with Voronoi diagram in Laguerre geometry based on random closed packing of spheres", 2004.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_foam(msq_context* context, msq_foam_def* def, msq_structure** structure);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_functional_def_init(msq_functional_def* def, UIntPtr size);

        /// <summary>Creates a functional structure: the points where a function of the position in the cell is at most a level. def must not be NULL.</summary>
        /// <remarks>
        /// <para>Expressions consist of numbers, pi, parameters, x, y, z, + - * / ^, parentheses, comparisons, and pow(a, b), min(a, b), max(a, b), abs, sqrt, sin, cos, exp, log (natural), tanh, atan2(y, x), hypot(a, b), floor, ceil, round, mod(a, b) and select(c, a, b). ^ binds tighter than a sign before it and associates to the right. x, y and z are angles from 0 to 2 pi. A function that is not periodic jumps at the cell border. Constant integer exponents from -65536 to 65536 are evaluated as products, or 1 over one; a^0 is the constant 1. Other powers are exp(b log(a)), so they need a &gt; 0. - Comparisons, &lt; &lt;= &gt; &gt;= == !=, bind weakest, do not associate, and are 1 or 0. - select(c, a, b) is a where c is above 0.5, otherwise b. - round(a) is floor(a + 0.5), ceil(a) is -floor(-a), mod(a, b) is a - b floor(a / b). - atan2 is above -pi and at most pi, and 0 where x and y are 0. hypot is sqrt(a a + b b).</para>
        /// <para>A NaN operand makes the result NaN, also for min and max, in either order (minimum and maximum of IEEE 754-2019). The operand that select does not choose is ignored. Points where the value is NaN are outside. Limits: 65536 bytes; 100 nested parentheses, signs and exponents; 8192 distinct operations, numbers and variables in total.</para>
        /// <para>Where floor, a comparison, select or atan2 may jump within the cell, the slope has no bound. Distances to such a structure are 0. Rays cross jumps, poles and NaN in steps of up to 1/1024 of a cell.</para>
        /// <para>Thickness is the volume of the walls divided by the area of their middle surface, where the function is 0, in one cell. msq finds the level from a curve of 512 pieces through 65^3 values of the function, accurate to about 0.3 % for the named functions (docs/concepts.md). Walls are thicker where the function is flatter. A field of thickness selects at each point the level of that thickness.</para>
        /// <para>With a period, the function is evaluated at the position in a cell of varying size. A level applies to cells of all sizes, so walls grow with the cells. A thickness is kept: at each position along the axis, msq uses the level that gives walls of this thickness in cells of the size there. Then only the spacing varies. Fill lines follow the middle of the walls in both cases. msq_fill_calibrate takes only structures without a period. Slices along the axes of the grid cost as much as those of a structure without a period whose cell size is no multiple of the pitch.</para>
        /// <para>With warped cells, the function is evaluated at the position in the cell, so walls are thicker where cells are wider. A level that is a field of the radius can keep their thickness. Distances are lower bounds, and 0 near the axis and the poles. Where rays have no bound of the function there, they advance in steps of up to 1/1024 of a cell. Layers across or along the axis of cylindrical cells are computed by rows, from tables of the function. Other layers are computed by boxes, then by points, which takes 30 to 40 times as long. Fill lines end where the cells end.</para>
        /// <para>Functions use IEEE operations only, not the C library, so their bits are equal on every machine. Cost: the first slice or grid makes clusters^3 interval evaluations (tens of milliseconds by default, seconds for the longest expressions); a thickness takes tens of milliseconds at construction, with a period up to a second. Errors: ARGUMENT (also: a thickness for a network, a thickness together with a level, a thickness that fills the cell, a thickness for a function that has no zero or is nowhere above 1e-300; a period whose positions do not ascend, or whose cell sizes leave their limits, with the index; a warp that leaves its limits; for expressions the message gives the position, from 1, and the reason), LIMIT (limits of expressions; more than 2^24 cells between the grid's origin and a position of the period), UNSUPPORTED (a field of thickness with a period; a thickness or a period with a warp), MEMORY. Source: paper, section "Preprocessing for Repeating Structures"; Schoen 1970; Fischer and Koch 1987; Karcher 1989; von Schnering and Nesper 1991; Wohlgemuth et al. 2001; Fisher et al. 2023 (docs/prior_art.md).</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_functional(msq_context* context, msq_functional_def* def, msq_structure** structure);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_waves_def_init(msq_waves_def* def, UIntPtr size);

        /// <summary>Creates a spinodal structure: the points where a sum of cosines of one wavelength, with random directions and phases, is at most the level (NETWORK), or its magnitude is (SHEET). def must not be NULL.</summary>
        /// <remarks>
        /// <para>Directions and phases are a function of the seed, equal on every machine. With many waves the sum is a Gaussian random field. volume_fraction is then met on average: the level is the inverse of the normal distribution. Samples of few wavelengths and sums of few waves differ from it; msq_structure_calibrate finds the level for a sample. A grid with different cell sizes stretches the structure. docs/concepts.md defines the sum.</para>
        /// <para>Cost: where a wavelength has 60 samples, a sample of a slice or a grid takes 0.5 ns, and 0.1 ns more for each 100 waves; any other point takes about 2 ns for each wave. Errors: ARGUMENT (also: both a level and a volume fraction), MEMORY. Source: Cahn 1965; Kumar, Tan, Zheng and Kochmann 2020.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_waves(msq_context* context, msq_waves_def* def, msq_structure** structure);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_beams_def_init(msq_beams_def* def, UIntPtr size);

        /// <summary>Creates a structure of beams: the points in at least one beam or ball of a list. It has no grid and is empty elsewhere. def must not be NULL. job NULL: no job.</summary>
        /// <remarks>
        /// <para>A beam is a conical frustum between two nodes, with a radius that is linear along its axis, and caps. A beam shorter than 1e-100 has no axis: its round caps are balls; with two flat caps it is dropped. Beams may overlap and repeat. Limits: 2^31 - 1 beams and balls in total; coordinates up to 1e75; radii 0 or from 1e-100 to 1e75. One radius of a beam may be 0; that of a ball may not. Cost: n log n, in parallel: about 0.3 us of processor time and 104 bytes per beam, of which 77 are kept. These bytes count against the memory limit of the context. Queries search a tree of boxes. Errors: ARGUMENT (also, with its index: a node that is not finite; a node index, radius or cap out of range), CANCELLED, LIMIT, MEMORY. Source: 3MF Consortium, "Beam Lattice Extension" 1.2.0; Kamel and Faloutsos, "On packing R-trees", 1993.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_beams(msq_context* context, msq_beams_def* def, msq_structure** structure, msq_job* job);

        /// <summary>Reads beam lattices from a 3MF file. def NULL: defaults; format must be MSQ_FORMAT_AUTO or MSQ_FORMAT_3MF. job NULL: no job. path as in msq_shape_from_file.</summary>
        /// <remarks>
        /// <para>A file has one or more lattices. Each makes a structure of its own (msq_beam_file_beams). Lattice 0 has all beams and balls of the build that no mesh clips. Each placed object whose beams a mesh clips is one more lattice. Everything is in millimetres and placed: units and transforms of items and components are applied. In the file a solid of beams is united with the triangles of its object; msq_beam_file_shape makes a shape of all triangles of the build.</para>
        /// <para>msq reads vertices, beams, radii at the ends, caps, balls and their three modes, minlength (shorter beams are dropped) and the clipping mode with its mesh. In ball mode "all", the vertices at which beams end have balls. Beam sets, properties and representation meshes do not change the solid and are ignored. Numbers become the nearest doubles.</para>
        /// <para>Limits: those of def; max_triangles is also the maximum number of beams and balls, and of triangles that clip. Cost: linear in the size of the file, about 1 us per beam on one thread. Memory: 44 bytes per beam and 24 per node are kept; reading takes up to ten times that. Errors: as msq_shape_from_file; UNSUPPORTED also for another format, a clipping mesh that has components or beams, and transforms that scale some directions by over 1e-4 more than others; MESH also for a file without beams, and for a node or radius that msq_structure_beams refuses. Source: 3MF Consortium, "Beam Lattice Extension" 1.2.0.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_beam_file_open(msq_context* context, byte* path, msq_file_def* def, msq_beam_file** file, msq_job* job);

        /// <summary>Reads beam lattices from bytes in memory. def must name the format and must not be NULL. See msq_beam_file_open. Errors: as msq_beam_file_open.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_beam_file_open_memory(msq_context* context, void* data, ulong bytes, msq_file_def* def, msq_beam_file** file, msq_job* job);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_beam_file_retain(msq_beam_file* file);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_beam_file_release(msq_beam_file* file);

        /// <summary>Reports the contents of a lattice of a file. Errors: ARGUMENT (lattice is not less than lattice_count).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_beam_file_info(msq_beam_file* file, ulong lattice, msq_beam_file_report* report);

        /// <summary>Fills in the definition of a lattice for msq_structure_beams, unclipped. The caller sets struct_size. The arrays of the definition belong to the file and are valid as long as it is; the other fields have their defaults. Errors: ARGUMENT (lattice is not less than lattice_count).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_beam_file_beams(msq_beam_file* file, ulong lattice, msq_beams_def* def);

        /// <summary>Creates a shape from a mesh of a file of beams, in millimetres. mesh: an msq_beam_file_mesh. winding_rule: an msq_winding. Cost and errors: as msq_shape_from_mesh; ARGUMENT also for lattice; MESH if the file has no such mesh.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_beam_file_shape(msq_context* context, msq_beam_file* file, ulong lattice, int mesh, int winding_rule, msq_shape** shape);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_host_structure_def_init(msq_host_structure_def* def, UIntPtr size);

        /// <summary>Creates a structure from callbacks. def must not be NULL. Every function of msq works with inside alone.</summary>
        /// <remarks>
        /// <para>A cell is built when a point in it is evaluated, and kept as long as the cache of the context keeps it. Two threads may build the same cell at once. Evicted cells are freed when the next cell is built, or with the structure. evaluate_cell has the data of one cell only: the data must include all that reaches into the cell from its neighbours. Cost: sets, grids and slices call back with batches, grouped by cell if build_cell is given. Single points and distances call back point by point. Errors: ARGUMENT, MEMORY. Calls that use the structure: HOST. Source: paper, section "Multiscale Shape-Material Modeling API".</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_host(msq_context* context, msq_host_structure_def* def, msq_structure** structure);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_host_function_def_init(msq_host_function_def* def, UIntPtr size);

        /// <summary>Creates a functional structure from callbacks, see msq_structure_functional. def must not be NULL. The function may be infinite but not NaN. With range or lipschitz, blocks that are entirely inside or outside are decided without evaluating points. Distances to its surface are 0. Cost: clusters^3 calls of range (32768 by default), and as many points of evaluate with lipschitz. Errors: ARGUMENT, HOST, MEMORY. Calls that use the structure: HOST. Source: paper, section "Preprocessing for Repeating Structures".</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_host_function(msq_context* context, msq_host_function_def* def, msq_structure** structure);

        /// <summary>Creates the union, intersection or difference of structures (operation: an msq_boolean_operation) from their memberships. structures: count structures, 1 to 4096, each on its own grid or on none. They may be of any kind, also made of structures themselves.</summary>
        /// <remarks>
        /// <para>The characteristic length is the largest of theirs. Hits of rays name no cell. msq_fill_calibrate refuses the result: call it for the structures themselves. Unions of structures with struts have struts, and an onset if all of them have one (msq_structure_struts, msq_set_onset). Distance of a union: the smallest of their signed distances, exact outside if theirs are, a bound inside. Of an intersection: the largest, a bound. Of a difference: that of the intersection with complements. The limit on cells (2^24 from the origin of the grid) applies to each of their grids. Cost: the sum of theirs. Errors: ARGUMENT, LIMIT (more than 64 structures made of structures within each other; more than 4096 structures in total, counted with repetition), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_boolean(int operation, msq_structure** structures, ulong count, msq_structure** structure);

        /// <summary>Creates a structure that changes from a to b. fraction: f, a number or a field, 0 to 1. Where f is 0 the solid is that of a; where f is 1 it is that of b. In between, the points with (1 - f) da + f db &lt;= 0 are solid, where da and db are the signed distances of a and b as msq returns them (docs/accuracy.md). So points in both are solid and points in neither are not. Surfaces move from those of a to those of b as f grows. On the same grid with like nodes struts stay whole; otherwise parts of a shrink while parts of b grow.</summary>
        /// <remarks>
        /// <para>Characteristic length, hits and limits on cells are as for msq_structure_boolean. Distance: a bound, with Lipschitz constant 1 if f has one. Rays march by it. Cost: the sum of theirs, and two distances at each sample that is in only one of them and has 0 &lt; f &lt; 1. The cost of a point is linear in the number of structures, also if blends and smooth booleans are nested. Sets and layers take the distance of a structure up to once for each blend or smooth boolean around it. Errors: ARGUMENT (also a fraction that leaves 0 to 1), LIMIT (as msq_structure_boolean), UNSUPPORTED (a distance of a or b has no Lipschitz constant: their radius, level or thickness is a field without one, a function has no bounded slope, or the host gives no distance), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_blend(msq_structure* a, msq_structure* b, msq_param* fraction, msq_structure** structure);

        /// <summary>Creates the union, intersection or difference (operation: an msq_boolean_operation; the difference is a without b) of two structures, with fillets where their surfaces meet. radius: k, a number or a field in model units, at least 0. Where it is 0 the solid is that of msq_structure_boolean. With the signed distances u and v to a and b as msq returns them (docs/accuracy.md), h = max(0, k - |u - v|) and s = min(u, v) - h^2 / (4 k), the union is the set of points with s &lt;= 0. An intersection takes -u and -v, a difference -u and v, and both are the sets of points with s &gt;= 0. So a union gains, and the others lose, points with sqrt(|u|) + sqrt(|v|) &lt;= sqrt(k): only where both surfaces are nearer than k. Between two planes at right angles the fillet is a parabola that touches both at the distance k from their edge.</summary>
        /// <remarks>
        /// <para>Characteristic length, hits and limits on cells are as for msq_structure_boolean. Distance: a bound, |s| / (1 + L / 4) for a radius with Lipschitz constant L. Rays march by it. Cost: that of msq_structure_boolean, and some distances near the fillets. Nested ones cost as in msq_structure_blend. Errors: ARGUMENT (also a radius that may be negative), LIMIT (as msq_structure_boolean), UNSUPPORTED (a distance of a or b has no Lipschitz constant, as for msq_structure_blend), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_smooth_boolean(int operation, msq_structure* a, msq_structure* b, msq_param* radius, msq_structure** structure);

        /// <summary>Hashes a structure, as msq_shape_hash does. The method of a foam and clusters do not count. Errors: as msq_shape_hash.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_hash(msq_structure* structure, byte* hash);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_structure_retain(msq_structure* structure);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_structure_release(msq_structure* structure);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_struts_def_init(msq_struts_def* def, UIntPtr size);

        /// <summary>Passes the struts of a lattice, a foam with struts or beams that a box selects to a callback: for beam models of finite elements, for 3MF, or for drawing.</summary>
        /// <remarks>
        /// <para>Lattices: the struts of the tiled unit cell, each once. Where struts coincide, the greatest factor counts. Equal nodes, within 1e-9 of the cell size, are one node, with the position of the first. Foams: the edges of the Voronoi diagram. A node is a point equally far from four or more seeds; its id comes from their names. Which seeds are equally far is decided exactly, at any jitter. Node positions are computed from the seeds in double precision. Where seeds are almost on one sphere, as with a jitter of 1e-9 to 1e-5, two nodes may be so close that the strut between them has equal ends. An id that would need more than 128 bits is a hash, which msq assumes to be unique. Beams: all beams and balls. A ball has equal a and b. Ends at the same coordinates are one node. id[0] is the index of the beam in the definition; balls are numbered after the beams. Foams with struts and walls: the struts. Unions: the struts of all members, one member after the other, with hashes of the members' ids as ids; cell is that of the member. Nodes of two members stay distinct, even where they coincide.</para>
        /// <para>With a shape, msq passes the parts of a strut's centre line that are inside the shape, in the order from a to b. Each cut end is inside the shape, within 2^-36 of the shape's size and coordinates of the place where membership changes on the line. Cut ends are found as the hits of rays are (msq_ray_cast). Parts and gaps shorter than that may be missed. The solid around the line is not cut. Radii at cut ends are evaluated there. The first piece has the id of the strut. Each other piece has an id of its own, and each cut end a node of its own.</para>
        /// <para>The order of struts and their bytes are the same on every call and on any number of threads. callback runs on the calling thread, with up to 4096 struts at once. It may call msq. def must not be NULL. job NULL: no job. The threads are those of the context. Memory: some megabytes, and the cells of foams in the cache. Cost: parallel; tens of nanoseconds per strut of lattices and beams, microseconds per strut of foams, whose cells are built. A tile of a foam also builds cells around it. Errors: ARGUMENT, UNSUPPORTED (functional and host structures, foams of walls alone, and structures made of others, except unions of those with struts: they have no struts), LIMIT (a box beyond 2^24 cells from the origin of the grid, or of 2^63 blocks of cells), HOST, CANCELLED, MEMORY. Source: 3MF Consortium, "Beam Lattice Extension" 1.2.0; Voronoi diagrams: Aurenhammer 1991.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_struts(msq_context* context, msq_structure* structure, msq_struts_def* def, IntPtr callback, void* user, msq_job* job);

        /// <summary>Collects the struts that msq_structure_struts passes, in the same order, and numbers their nodes in the order in which they first occur. Cost: as msq_structure_struts, and a table of the nodes on the calling thread. Memory: 56 bytes per strut and 40 per node, accounted to the context; while the call lasts, up to four times as much. Errors: as msq_structure_struts; LIMIT also for memory or more than 2^32 - 2 nodes.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_strut_graph(msq_context* context, msq_structure* structure, msq_struts_def* def, msq_strut_graph** graph, msq_job* job);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_strut_graph_retain(msq_strut_graph* graph);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_strut_graph_release(msq_strut_graph* graph);

        /// <summary>Reports the contents of a graph. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_strut_graph_info(msq_strut_graph* graph, msq_strut_graph_report* report);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_material_def_init(msq_material_def* def, UIntPtr size);

        /// <summary>Creates a material. def must not be NULL. Errors: ARGUMENT, MEMORY. Source: paper, section "Multiscale Shape-Material Modeling API".</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_material_create(msq_context* context, msq_material_def* def, msq_material** material);

        /// <summary>Creates a blend of two materials: each channel is (1 - f) * a + f * b, where f is the fraction at the point, 0 to 1 everywhere. id: the id of the blend, positive. Errors: ARGUMENT (also if one material has a channel that the other lacks), LIMIT (more than 64 nested blends, or more than 4096 materials in a blend, counted with repetition), MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_material_blend(msq_context* context, uint id, msq_material* a, msq_material* b, msq_param* fraction, msq_material** material);

        /// <summary>Hashes a material, as msq_shape_hash does: its id, and its channels in their order. Errors: as msq_shape_hash.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_material_hash(msq_material* material, byte* hash);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_material_retain(msq_material* material);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_material_release(msq_material* material);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_model_def_init(msq_model_def* def, UIntPtr size);

        /// <summary>Creates a model: the intersection of the shape with every structure. Where a scale leaves a skin, the union of structure and skin takes the place of the structure. def must not be NULL.</summary>
        /// <remarks>
        /// <para>The skin is the set of points of the shape whose depth is at most the thickness at the point, where the thickness is above 0. Depth is the distance to the boundary of the shape, as in msq_point_distance. Primitives and meshes have depth; voxel images, host shapes and some shapes made of shapes only bound the distance. Cost: constant; with a skin on a mesh, the first call that needs it builds a tree of the triangles. Errors: ARGUMENT, LIMIT (the shape has bounds and reaches 2^24 cells from the origin of a structure's grid), UNSUPPORTED (a skin in a shape without depth: docs/concepts.md), MEMORY. Source: paper, section "Multiscale Shape-Material Modeling API"; the paper has no skin.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_model_create(msq_context* context, msq_model_def* def, msq_model** model);

        /// <summary>Creates a model of several regions, for example the parts of a plate and the modifier volumes in them. regions: count models, 1 to 4096; each has its own shape, scales, skins and materials.</summary>
        /// <remarks>
        /// <para>A point belongs to the first region whose shape contains it, and is inside if it is inside that region. Later regions are ignored there, also where the region is empty. A region that is itself a model of regions is replaced by these, in their order. All functions take the model: one slice, ray or query serves a whole plate. Its coarse shape is the union of those of its regions. Scales are numbered by region: hits name the scale of the region that they are in, and msq_model_scale_length returns the largest length of any region.</para>
        /// <para>Cost: constant. In sets, slices and grids, a sample costs the memberships in the shapes before its region, and the evaluation of its region. Slabs take two more bits per sample. Errors: ARGUMENT, LIMIT (more than 4096 regions), UNSUPPORTED (a region of all space), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_model_regions(msq_context* context, msq_model** regions, ulong count, msq_model** model);

        /// <summary>Hashes a model, as msq_shape_hash does: its shape, and the structure, skin and materials of each scale; or its regions in their order. Errors: as msq_shape_hash.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_model_hash(msq_model* model, byte* hash);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_model_retain(msq_model* model);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_model_release(msq_model* model);

        /// <summary>Returns the bounding box of the coarse shape, which contains the model; for regions, the box around all of them. Infinite for msq_shape_all_space. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_model_bounds(msq_model* model, double* min, double* max);

        /// <summary>Returns the characteristic length of a scale: its largest cell size; the length_scale of beams, which have no cells; infinity for scale 0. Errors: ARGUMENT (no such scale).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_model_scale_length(msq_model* model, uint scale, double* length);

        /// <summary>Returns the shape of scale 0, or the structure of another scale. The output that the scale does not have receives NULL. The caller releases the handle. region: its index, from 0; 0 for a model without regions. shape, structure NULL: not wanted. Errors: ARGUMENT (no such region or scale).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_model_scale(msq_model* model, uint region, uint scale, msq_shape** shape, msq_structure** structure);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_query_def_init(msq_query_def* def, UIntPtr size);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_points_def_init(msq_points_def* def, UIntPtr size);

        /// <summary>Writes points first to first + count - 1 of a set as count triples x, y, z: the exact numbers that queries of the set use. Cost: about 5 ns per point, on the calling thread. Errors: ARGUMENT (also past the end). Source: paper, section "Structured and Unstructured Set Queries"; Steele, Lea and Flood 2014 (SplitMix64).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_points_generate(msq_points_def* points, ulong first, ulong count, double* coordinates);

        /// <summary>Membership of one point: *inside receives 1 in the model or on its boundary, otherwise 0. query NULL: defaults. For the boundary of meshes see msq_shape_from_mesh.</summary>
        /// <remarks>
        /// <para>This function is the definition. All other queries agree with it bit for bit. The one exception is MSQ_FOAM_METHOD_2 with a jitter below 0.01, within 1e-9 of a cell of the boundary. Cost: a mesh tests the triangles in one y, z bin; a lattice the struts that can reach the cell; a foam 27 to a few hundred seeds (about a microsecond). Errors: ARGUMENT, MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_point_membership(msq_model* model, double* point, msq_query_def* query, int* inside);

        /// <summary>Membership of a set: inside[i] receives 1 or 0 for point i. inside_count must be the number of points. query NULL: defaults. job NULL: no job.</summary>
        /// <remarks>
        /// <para>Scales are evaluated from coarse to fine. A finer scale does not evaluate points that a coarser one decided (msq_job_info counts them). ARGUMENT and LIMIT write nothing; CANCELLED and MEMORY may leave inside partly written. Cost: arrays in parallel; foams group points by cell first, in any order, with 0.2 MB per thread, and 6 bytes per point and at most 15 MB. The latter become less, down to 0.1 MB, if the memory limit leaves no room. Grids cost far less per point, as slices do. Stratified samples need no grouping and no memory. Errors: ARGUMENT (also points that are not finite, with their index), CANCELLED, LIMIT, MEMORY. Source: paper, section "Set-based queries".</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_set_membership(msq_model* model, msq_points_def* points, msq_query_def* query, byte* inside, ulong inside_count, msq_job* job);

        /// <summary>Region of one point: *region receives the index of the first region whose shape contains it, -1 if none does. The point need not be in the solid of the region. A model that is not made of regions is region 0. Regions of regions are counted in their order. Errors: ARGUMENT, MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_point_region(msq_model* model, double* point, int* region);

        /// <summary>Regions of a set: regions[i] receives the result of msq_point_region for point i. region_count must be the number of points. job NULL: no job. ARGUMENT and LIMIT write nothing; CANCELLED and MEMORY may leave regions partly written. Cost: in parallel, the memberships in the shapes. Errors: ARGUMENT (also points that are not finite, with their index), CANCELLED, LIMIT, MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_set_region(msq_model* model, msq_points_def* points, int* regions, ulong region_count, msq_job* job);

        /// <summary>Material of one point. *id receives the id of its material, or MSQ_MATERIAL_VOID outside the model. values[c] receives the value of the channel named channels[c]; 0 outside, and where the material has no such channel. query NULL: defaults. channels and values may be NULL if channel_count is 0.</summary>
        /// <remarks>
        /// <para>The material is that of the finest resolved scale that has one, or of its skin inside the skin. Where finer scales are not resolved, the host's material represents the mixture. Errors: ARGUMENT (also if no resolved scale of the model, or of one of its regions, has a material, or none of their materials has a channel of that name), MEMORY. Source: paper, section "Multiscale Shape-Material Modeling API".</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_point_material(msq_model* model, double* point, msq_query_def* query, byte** channels, ulong channel_count, uint* id, double* values);

        /// <summary>Materials of a set: ids[i] and values[i * channel_count + c] receive, bit for bit, the result of msq_point_material for point i. id_count must be the number of points, value_count channel_count times that. query NULL: defaults. job NULL: no job. ARGUMENT and LIMIT write nothing; CANCELLED and MEMORY may leave the arrays partly written. Cost: msq_set_membership plus a byte per point; channels are evaluated at the points inside. Errors: ARGUMENT (also points that are not finite, with their index), CANCELLED, LIMIT, MEMORY. Source: paper, section "Set-based queries".</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_set_material(msq_model* model, msq_points_def* points, msq_query_def* query, byte** channels, ulong channel_count, uint* ids, ulong id_count, double* values, ulong value_count, msq_job* job);

        /// <summary>Signed distance of one point to the boundary of the model, in model units. *distance is positive, at least 2.2e-308, where msq_point_membership returns 0, and at most 0 where it returns 1. It is always finite. query NULL: defaults.</summary>
        /// <remarks>
        /// <para>The magnitude never exceeds the true distance, so a step of that length along a ray crosses no surface. It is exact for primitives, clean meshes, and outside of lattices and foams with a constant radius, and a lower bound otherwise. docs/accuracy.md tells, for each kind of shape and structure, where the distance is exact and how tight the bound is. Outside the model the distance is that of the coarsest scale that the point is outside of; inside, that of the nearest boundary of any scale. For regions it is a bound, which ends where another region begins (docs/accuracy.md).</para>
        /// <para>Cost: a mesh builds a tree of its triangles on first use (n log n; seconds for millions; about 120 bytes per triangle until the shape is freed) and then visits about log n nodes. A lattice evaluates the struts that can be nearest, a foam the edges of the seeds around the point (microseconds). A functional structure takes about ten milliseconds on first use to bound its slope. Errors: ARGUMENT, LIMIT (tree above the memory limit), MEMORY. Source: paper, section "Multiscale Shape-Material Modeling API"; Hart, "Sphere tracing", 1996.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_point_distance(msq_model* model, double* point, msq_query_def* query, double* distance);

        /// <summary>Signed distances of a set: distance[i] receives, bit for bit, the result of msq_point_distance for point i. distance_count must be the number of points. query NULL: defaults. job NULL: no job. ARGUMENT and LIMIT write nothing; CANCELLED and MEMORY may leave distance partly written. Cost: msq_point_distance in parallel, less for foams if points of a cell follow each other. Errors: ARGUMENT (also points that are not finite, with their index), CANCELLED, LIMIT, MEMORY. Source: paper, section "Set-based queries".</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_set_distance(msq_model* model, msq_points_def* points, msq_query_def* query, double* distance, ulong distance_count, msq_job* job);

        /// <summary>Writes the onset of a structure, without a model, at each point of a set. value: an msq_onset_value. onsets[i]: the onset of point i; infinity where it is not a number or is above a limit. The limit is 4 times the smallest cell size for lattices and plates, over their greatest factor; the smallest cell size for walls with holes; and the smallest limit of the members for unions, where that of foams is the smallest cell size. Alone, foams without holes have no limit. onset_count must be the number of points.</summary>
        /// <remarks>
        /// <para>gradients NULL: not wanted, and gradient_count is 0. Otherwise gradients[3 * i + axis] receives the derivative along an axis of the model, and gradient_count is 3 * onset_count. It is a central difference over 2^-17 of the smallest cell size on either side. Its error is about 1e-8 of the largest slope where the function is smooth. Along ridges it is a mean of both sides. It is 0 where it is not finite.</para>
        /// <para>MSQ_ONSET_SIGNED agrees in sign with membership; for lattices and foams except within 1e-9 of a cell of the boundary. job NULL: no job. ARGUMENT, LIMIT and UNSUPPORTED write nothing; CANCELLED, HOST and MEMORY may leave the arrays partly written. Cost: in parallel, lattices and functions about 0.1 us per point, foams 1.5 us, a wave 2 ns; seven times that with gradients; foams less if points of a cell follow each other. Errors: ARGUMENT (also points that are not finite, with their index), UNSUPPORTED (kinds without onset, as in msq_structure_calibrate), LIMIT (a point 2^24 cells from the origin of the grid), HOST (fields), CANCELLED, MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_set_onset(msq_context* context, msq_structure* structure, msq_points_def* points, int value, double* onsets, ulong onset_count, double* gradients, ulong gradient_count, msq_job* job);

        /// <summary>Writes the value of a field at each point of a set: values[i] is the number that msq uses at point i. value_count must be the number of points. job NULL: no job. ARGUMENT writes nothing; CANCELLED, HOST and MEMORY may leave values partly written. Cost: that of the field (docs/concepts.md), in parallel. Errors: ARGUMENT (also points that are not finite, with their index), HOST, CANCELLED, MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_field_evaluate(msq_context* context, msq_field* field, msq_points_def* points, double* values, ulong value_count, msq_job* job);

        /// <summary>Estimates the volume fraction of a phase (msq_phase) in the box of the sample. query NULL: defaults. job NULL: no job. Cost: msq_set_membership. Errors: ARGUMENT, CANCELLED, MEMORY. Source: paper, section "Set-based queries"; Cochran, "Sampling Techniques", 1977, chapter 5.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_volume_fraction(msq_model* model, msq_points_def* sample, msq_query_def* query, int phase, msq_estimate* estimate, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_segments_def_init(msq_segments_def* def, UIntPtr size);

        /// <summary>Estimates the two-point correlation S2: estimates[i] receives the probability that both ends of a segment of length i are in the phase. At length 0 this is the volume fraction. estimate_count must be length_count. query NULL: defaults. job NULL: no job. Cost: msq_set_membership of the sample, and again per length of those points that are in the phase. Errors: ARGUMENT, CANCELLED, MEMORY. Source: Torquato, "Random Heterogeneous Materials", 2002, section 2.2.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_two_point_correlation(msq_model* model, msq_points_def* sample, msq_query_def* query, msq_segments_def* def, msq_estimate* estimates, ulong estimate_count, msq_job* job);

        /// <summary>Estimates the lineal-path function L: estimates[i] receives the probability that a segment of length i lies entirely in the phase. Arguments as in msq_two_point_correlation.</summary>
        /// <remarks>
        /// <para>msq follows a segment by the steps that msq_point_distance allows, which cross no boundary, and near boundaries by the step of def. Gaps shorter than that step may be missed; longer ones never are. Ends are found within a thousandth of the step. Cost: tens of distances per point, and one per step where the distance is 0. Errors: ARGUMENT, CANCELLED, LIMIT (a length above 10^6 steps), MEMORY. Source: Torquato 2002, section 2.4; Lu and Torquato 1992.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_lineal_path(msq_model* model, msq_points_def* sample, msq_query_def* query, msq_segments_def* def, msq_estimate* estimates, ulong estimate_count, msq_job* job);

        /// <summary>Finds the constant parameter (radius of struts, level of a function) at which a structure has a target volume fraction, and the curve between the two. The parameter of the structure itself is ignored.</summary>
        /// <remarks>
        /// <para>target: 0 to 1. parameters, fractions: receive pair_count pairs (2 to 2^20). At parameters[i] the fraction is fractions[i] = i / (pair_count - 1) * max_fraction. Radii and thicknesses are in model units. The fractions ascend strictly; neighbouring parameters may be equal. They convert a field of density to one of radius (msq_field_map). parameters and fractions must be NULL if pair_count is 0. report NULL: not wanted. sample NULL: 2 points in each of 64^3 parts of a box that begins at the origin of the grid. The box is one cell for lattices and functional structures, and 16^3 cells for foams and waves. With a period these are cells of the smallest size; in unions they are those of the grid with the largest cells. Structures in warped cells need a sample. job NULL: no job. Cost: the onset of each point (lattices 0.1 us, in warped cells 10 to 100 us; foams 1.5 us; in parallel) and a sort; 16 bytes per point, accounted to the context. Errors: ARGUMENT, UNSUPPORTED (kinds without onset: lattices with two or more unit cells, lattices of plates and struts, foams of struts and walls, host structures and functions, beams, and structures made of others, except unions of lattices of struts and foams of struts alone), CANCELLED, LIMIT (target above max_fraction; points 2^24 cells or more from the origin of a grid, or beyond 1e75; memory), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_structure_calibrate(msq_context* context, msq_structure* structure, msq_points_def* sample, double target, double* parameters, double* fractions, ulong pair_count, msq_calibration_report* report, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_contours_def_init(msq_contours_def* def, UIntPtr size);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_output_def_init(msq_output_def* def, UIntPtr size);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_slicer_def_init(msq_slicer_def* def, UIntPtr size);

        /// <summary>Plans the layers of a model, normal to z or in a frame. Computes nothing yet. def must not be NULL. Errors: ARGUMENT (also pixels or layers that rounding makes coincide, and a window outside the plan), LIMIT (more than 2^31 - 1 layers, or pixels along a side, or 2^63 pixels in total or in the window), UNSUPPORTED (ONSET of a model of several regions, or of a structure without onset), MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_slicer_create(msq_model* model, msq_slicer_def* def, msq_slicer** slicer);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_slicer_retain(msq_slicer* slicer);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_slicer_release(msq_slicer* slicer);

        /// <summary>Reports the plan. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_slicer_info(msq_slicer* slicer, msq_slicer_report* report);

        /// <summary>Returns z of the samples of a layer. Errors: ARGUMENT (index out of range).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_slicer_layer_z(msq_slicer* slicer, ulong index, double* z);

        /// <summary>Computes layers first to first + count - 1 and passes each to the callback, in ascending order, on the calling thread. Workers compute the next slab meanwhile and wait for the callback. (With the host's parallel_for, the next slab is computed after the callbacks of the slab.) count UINT64_MAX: to the last layer. job NULL: no job. The bytes of a layer do not depend on how the plan is split into calls or processes, nor on its other outputs. Memory, accounted to the context: two slabs, one layer and a few tiles per thread, for any height of the stack. If two slabs of one layer exceed memory_limit, a run takes one layer, two bands of its rows (at least 16 rows of samples each) and a few tiles per thread. If that exceeds the limit too, the run fails with LIMIT: use windows. Foams also keep cells in the cache. Workers compute the contours of as many layers at once as there are threads, and as many wait for the callback. If these exceed memory_limit, contours are computed layer by layer. Errors: ARGUMENT, CANCELLED, HOST, LIMIT, MEMORY; contours also those of msq_layer_contours, before their layer. Source: paper, section "Slicing".</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_slicer_run(msq_slicer* slicer, ulong first, ulong count, IntPtr fn, void* user, msq_job* job);

        /// <summary>Computes the first output of one layer, the same bytes as msq_slicer_run, into a buffer of at least layer_bytes. A call that fails leaves the buffer untouched. For all outputs of one layer call msq_slicer_run with a count of 1. Cost: about that of msq_slicer_run for a layer that follows one which any thread requested recently. Such layers are computed together, by all threads that request them. Other layers cost up to three times as much. Memory: the bits of one layer and a few tiles per thread; if these exceed memory_limit, one layer and a band of its rows. Layers that are computed ahead take at most two slabs, until the slicer is freed or a call needs the memory. Errors: ARGUMENT (also if the first output is contours), CANCELLED, LIMIT, MEMORY.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_slice_layer(msq_slicer* slicer, ulong index, byte* buffer, ulong buffer_bytes, msq_job* job);

        /// <summary>Computes the contours of the section of a model at a height along the axis.</summary>
        /// <remarks>
        /// <para>Rings are closed and simple, and no two of them meet. The inside is on the left: outer rings are counter-clockwise in (u, v), holes clockwise. Corners are points of the rings. Points that the tolerance does not need are left out. Rings come in the order of the lowest rows of nodes that they reach, so a ring's parent has a smaller index. The same arguments yield the same bytes, on any thread.</para>
        /// <para>contours: a new handle. job NULL: no job. Any number of threads may call it at once. Memory: in proportion to the window's nodes and crossings, accounted to the context while the call lasts. The result is not accounted. Errors: ARGUMENT, CANCELLED, HOST, LIMIT (2^31 nodes along an axis; 2^32 crossings; coordinates beyond the type, for int64 beyond 2^53; memory), MEMORY. Source: marching squares; Imai and Iri 1986.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_layer_contours(msq_model* model, double height, msq_contours_def* def, msq_contours** contours, msq_job* job);

        /// <summary>Computes the contours of a layer of a slicer, at the layer's z and with the slicer's length_scale. axis must be 2. has_window 0: the rectangle of the slicer's pixels. Errors: as msq_layer_contours; ARGUMENT also for an index out of range.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_slicer_contours(msq_slicer* slicer, ulong index, msq_contours_def* def, msq_contours** contours, msq_job* job);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_contours_retain(msq_contours* contours);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_contours_release(msq_contours* contours);

        /// <summary>Reports the rings of contours. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_contours_info(msq_contours* contours, msq_contours_report* report);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_printability_def_init(msq_printability_def* def, UIntPtr size);

        /// <summary>Finds possible problems in printing a slicer's layers: islands, loose parts, enclosed voids, thin places, cups, overhangs.</summary>
        /// <remarks>
        /// <para>It inspects all layers of the slicer, one sample per pixel at its centre; output and orientation of the slicer are ignored. Features smaller than a pixel may lie between samples: to find them, use a slicer with a finer pitch. Solid samples of a layer are connected across sides and corners, empty ones across sides; samples of two layers are connected if one is on the other.</para>
        /// <para>def NULL: defaults. fn NULL: no list. Otherwise fn is called on the calling thread with each finding once, after the layer that ends it, in an order that depends on the layers alone. Results do not depend on threads and slabs. job NULL: no job. Memory: that of msq_slicer_run, up to 22 bits per pixel of a layer, and runs and totals of parts outside of the main body, for any height of the stack. Runs and totals are accounted to the context after each layer. Workers share the rows of each layer. Cost: 1.2 to 1.4 times that of msq_slicer_run for bits of foams of struts and of turned lattices, 1.7 to 2.5 times for lattices and functions along the grid, whose bits cost little, and for thousands of enclosed voids in a layer. Where rows repeat, bits are copies, and the cost is up to 0.2 ns per sample more than theirs. THIN, CUP and OVERHANG add to that: see docs/benchmarks.md. Errors: ARGUMENT, CANCELLED, HOST, LIMIT (memory; 2^32 - 1 runs in a layer), MEMORY. Source: Hoshen and Kopelman, "Percolation and cluster distribution", 1976.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_printability(msq_slicer* slicer, msq_printability_def* def, IntPtr fn, void* user, msq_printability_report* report, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_fill_def_init(msq_fill_def* def, UIntPtr size);

        /// <summary>Computes the middle lines of a structure's thin walls at a height, within a polygon.</summary>
        /// <remarks>
        /// <para>The lines are the section of the plane at z with these surfaces: the faces of a foam's diagram, without the holes of vent_radius; the plates of a plate lattice; for a sheet, the surface where the function, or the sum of waves, is 0; for a network, the surface where it equals the level. A union has the lines of all members. An intersection has the lines of its first member that are inside all others. A difference has the lines of its first member that are outside of all others. Radius, level of sheets and thickness are ignored. Lattices of struts, beams, blends and structures of msq_structure_host have no such lines; use contours for them.</para>
        /// <para>Each line is in one path. No line is printed twice unless pair_distance is set. The number of paths is the minimum: half the number of points where a path must end. These are the points at the border and the junctions of three, five, ... lines. At a junction, the lines that are most nearly straight are joined, unless this adds paths. Paths come in printing order: each begins near the end of the one before. The travel between connected lines is a few percent above the minimum. Lines of a function that cross, as at the heights where a Schwarz P surface has straight ones, may touch there without a junction: the function's samples tell two lines apart that turn.</para>
        /// <para>Ends of lines at the polygon's border are rounded to whole coordinates. All other decisions are exact. Lines on the border itself count as inside on one side of the polygon. Where polygons of a layer touch, lines go on from one to the other: those of foams at the same point, those of plates within a few units, those of functions and waves, which are simplified from each polygon's border on, within twice the tolerance. Functions are sampled on a grid of 1/32 of the smallest cell size, waves on one of 1/16 (docs/concepts.md has the grid of warped cells). Lines closer together than that may be joined, and smaller closed lines lost.</para>
        /// <para>def must not be NULL. job NULL: no job. Limits: coordinates up to 2^53 in magnitude; 2^24 cells from the origin of the grid; about 2^26 seeds or 2^26 squares along a side of the polygon's box. Cost: on the calling thread; many threads may call at once. About 20 us per cell of a foam or of plates; 1 us per square that a function's line crosses, 20 ns per other square; of waves 11 ns per wave and square that a line crosses. Errors: ARGUMENT (also, with its index: a ring of fewer than 3 points or whose points are on one line; a pair_distance or corner_distance above 2^54 units), UNSUPPORTED (no thin walls), LIMIT, CANCELLED, HOST, MEMORY. Source: Aurenhammer, "Power diagrams", 1987; Lorensen and Cline, "Marching cubes", 1987; Edmonds and Johnson, "Matching, Euler tours and the Chinese postman", 1973.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_fill_lines(msq_context* context, msq_structure* structure, msq_fill_def* def, msq_fill** fill, msq_job* job);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_fill_retain(msq_fill* fill);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_fill_release(msq_fill* fill);

        /// <summary>Reports the paths. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_fill_info(msq_fill* fill, msq_fill_report* report);

        /// <summary>Finds the cell sizes at which a structure's fill lines cover a given share of the area.</summary>
        /// <remarks>
        /// <para>line_width: in model units, positive. density: this share, above 0 and at most 1. It is the length of the lines per area, times line_width, on average over all heights. It is inversely proportional to the cell size. cell_size receives the cell sizes of the structure's grid, all multiplied by the same factor. Create the structure anew with these and the same rotation. Multiply weight and vent_radius of a foam by the same factor. job NULL: no job.</para>
        /// <para>Single layers differ from the average, those of a gyroid by a tenth. msq measures the lines of the structure as it is defined: one cell at 64 heights, or 8 x 8 cells at 61 or 64 heights if the grid is rotated, or 32 x 32 cells of foams and waves at 32 heights. It is accurate to about 0.5 %. Calibrate a foam without its field of density: d seeds per cell volume multiply the density of lines by about the cube root of d.</para>
        /// <para>Cost: up to 0.5 s for a foam, 0.8 s and 0.017 s per wave for waves. Errors: ARGUMENT, UNSUPPORTED (a structure without thin walls; a structure whose lines are denser in some places, by a period, a warp, or a field of density, vent_radius or the level of a network; a structure made of other structures), LIMIT (a structure without lines; cells that would be below 1e-75 or above 1e75), CANCELLED, HOST, MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_fill_calibrate(msq_context* context, msq_structure* structure, double line_width, double density, double* cell_size, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_surface_def_init(msq_surface_def* def, UIntPtr size);

        /// <summary>Computes triangles of the boundary of a model within a box, for display and for programs that take only meshes. Layers, contours, rays and distances do not need a mesh: msq computes them from the model itself, faster and exactly.</summary>
        /// <remarks>
        /// <para>The mesh is closed, and a manifold: each edge has two triangles, which run through it in opposite directions, and the triangles around a vertex are one ring. Each vertex is within pitch / 1000 of the boundary of the model cut with the box. Edges and corners of the model that are wider apart than the pitch are kept. Triangles may intersect where the boundary is bent within a pitch.</para>
        /// <para>Callbacks run on the calling thread, from low z to high z. The parts together do not depend on slab_layers, threads or calls. If no node is inside the model, the callback is not called. def must not be NULL. job NULL: no job. Cost: parallel; two rays per vertex and one sample per node. Memory: about 200 bytes per vertex of a part, and the nodes of a slab, accounted to the context. Errors: ARGUMENT (also a pitch that is too small for the coordinates), CANCELLED, HOST, LIMIT (2^31 nodes along an axis; 2^32 vertices; memory), MEMORY. Source: Schaefer, Ju and Warren, "Manifold dual contouring", 2007.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_surface_mesh(msq_model* model, msq_surface_def* def, IntPtr fn, void* user, msq_job* job);

        /// <summary>Computes the mesh of msq_surface_mesh as the bytes of a file. format: an msq_surface_format.</summary>
        /// <remarks>
        /// <para>Each byte of the file is in one part. Parts of MSQ_SURFACE_STL come in the order of the file. In MSQ_SURFACE_PLY vertices come before triangles, so its parts alternate between two places: seek to offset, or copy to it in memory of total bytes. The bytes of the file do not depend on slab_layers or threads. Coordinates are rounded to float32: far from the origin, vertices closer together than that may coincide.</para>
        /// <para>Cost: as msq_surface_mesh, and the samples once more, to count triangles before the first is written. If no node is inside the model, the file has no triangles. Errors: as msq_surface_mesh; LIMIT also for 2^32 triangles or 2^31 vertices.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_surface_file(msq_model* model, msq_surface_def* def, int format, IntPtr fn, void* user, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_rays_def_init(msq_rays_def* def, UIntPtr size);

        /// <summary>Finds where each ray first meets the solid at t_min &lt;= t &lt;= t_max. hits[i] belongs to ray i. hit_count must be the number of rays. query NULL: defaults. job NULL: no job. A solid that begins at t_max is hit if the rounded point there is inside.</summary>
        /// <remarks>
        /// <para>Membership (msq_point_membership) changes within a tolerance of t. The tolerance is 2^-36 of the characteristic length of the scale that was hit, or 2^-50 of the largest coordinate of the ray in the shape's box, relative to the origin and to that of the grid, if that is more. Before t membership does not change, except over parts of the ray shorter than the tolerance. Exceptions: shapes and structures that are defined by callbacks, by images, or by fields without a Lipschitz constant. docs/accuracy.md lists the tolerance of position and normal for each kind. Points of a ray are accurate to 2^-53 of the distance from its origin. The search ends for every ray. t is finite in each hit. Results do not depend on the order of the rays.</para>
        /// <para>Finer scales are evaluated only where the ray is inside the coarser ones. ARGUMENT and LIMIT write nothing; CANCELLED and MEMORY may leave hits partly written. Cost: parallel. Rays that are close together share work; rays in random order are sorted first, up to 2^20 at once, with 16 bytes each and at most 1/16 of the memory limit. A mesh builds its tree first, as for msq_point_distance. Errors: ARGUMENT (also rays that are not finite and directions of length 0, with their index), CANCELLED, LIMIT, MEMORY. Source: paper, section "Set Queries for Ray-Casting".</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_ray_cast(msq_model* model, msq_rays_def* rays, msq_query_def* query, msq_ray_hit* hits, ulong hit_count, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_camera_init(msq_camera* camera, UIntPtr size);

        /// <summary>Sets eye, target, up and height so that the bounding box of the model fits a picture of width x height pixels (1 to 16384 each). direction: from eye to target, of any length except 0. up NULL: z, or y if z is within 2.6 degrees of the view. Other fields keep their values; a perspective camera uses field_of_view. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_camera_fit(msq_model* model, double* direction, double* up, uint width, uint height, msq_camera* camera);

        /// <summary>Returns the ray of a position in a picture of width x height pixels. position: pixels to the right of and below the upper left corner; the centre of pixel (i, j) is (i + 0.5, j + 0.5). With the returned direction the t of msq_ray_cast is the depth, and a ray from t_min = clip_near to t_max = clip_far hits exactly what msq_render draws. Use it for picking, and for pictures that the host renders itself. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_camera_ray(msq_camera* camera, uint width, uint height, double* position, double* origin, double* direction);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_render_def_init(msq_render_def* def, UIntPtr size);

        /// <summary>Sets the defaults: no arrays. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_frame_init(msq_frame* frame, UIntPtr size);

        /// <summary>Renders a model as a camera sees it.</summary>
        /// <remarks>
        /// <para>Depth, normal, scale and material of a pixel are those of msq_ray_cast for the ray through its centre. Its colour is the mean, in linear light, of its samples: the background, or</para>
        /// <para>base * (ambient * open + (1 - ambient) * max(0, normal . light) * lit)</para>
        /// <para>where base is the colour that colour_by selects, open is the share of occlusion rays that hit nothing, and lit is 0 in shadow, otherwise 1. open and lit are 1 if not requested. What the clip planes cut away casts no shadow. A pixel has the same bits for any tile, passes and threads.</para>
        /// <para>fn NULL: no callback. Otherwise fn is called on the calling thread after each pass: steps from first_step, halved each time, down to 1; then one with all samples if rgba has more than one per pixel. query NULL: defaults. job NULL: no job. ARGUMENT writes nothing; other errors may leave the frame partly written.</para>
        /// <para>Cost: one ray per pixel and samples^2 more if samples &gt; 1, each with its shadow and occlusion rays; in parallel, in tiles of 32 x 32 rays. A mesh builds its tree first, as for msq_point_distance. Memory: about 1 MB per thread, kept for the next call. Errors: ARGUMENT, CANCELLED, HOST, LIMIT, MEMORY. Source: paper, section "Set Queries for Ray-Casting".</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_render(msq_model* model, msq_camera* camera, msq_render_def* def, msq_query_def* query, msq_frame* frame, IntPtr fn, void* user, msq_job* job);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_document_def_init(msq_document_def* def, UIntPtr size);

        /// <summary>Reads a document from text in memory: JSON in UTF-8, of `bytes` bytes. def NULL: defaults. job NULL: no job; its progress is that of the file which is being read.</summary>
        /// <remarks>
        /// <para>msq builds every object of the document with the functions above, with their checks and warnings. Lengths are in the model's unit. Unknown keys, keys that occur twice and definitions that contain themselves are refused. A message begins with line, column and path of the value that is at fault, for example "12:17: scales[1].structure.foam.radius: ...". Lines and columns begin at 1; columns count bytes.</para>
        /// <para>Cost: about 100 ns per value of the document, 40 bytes per value while it is read, and the cost of the objects. Errors: ARGUMENT (text that is not JSON, a document that is not in the format, a path that is not allowed, and as the functions that create its objects), IO, UNSUPPORTED (a build without nlohmann-json), LIMIT, MESH, CANCELLED, MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_document_from_json(msq_context* context, byte* text, ulong bytes, msq_document_def* def, msq_document** document, msq_job* job);

        /// <summary>Reads a document from a file. path: as in msq_shape_from_file. Its messages begin with the path. def NULL: defaults. job NULL: no job. The rest is as in msq_document_from_json. Errors: as msq_document_from_json.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_document_from_file(msq_context* context, byte* path, msq_document_def* def, msq_document** document, msq_job* job);

        /// <summary>Adds a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_document_retain(msq_document* document);

        /// <summary>Drops a reference.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        void msq_document_release(msq_document* document);

        /// <summary>Reports the contents of a document. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_document_info(msq_document* document, msq_document_report* report);

        /// <summary>Returns the model of a document, with a reference for the caller to release. The model does not need the document any more. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_document_model(msq_document* document, msq_model** model);

        /// <summary>Writes the settings for slices to *def, whose struct_size the caller has set. Fields that the document does not set have their defaults. The pointers in it are valid as long as the document. The host may change def before msq_slicer_create checks it. Errors: ARGUMENT (also a document without slicing).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_document_slicing(msq_document* document, msq_slicer_def* def);

        /// <summary>Writes the settings for pictures to *camera and *render, whose struct_size the caller has set. A view along a direction is already fitted to the model, as by msq_camera_fit. The pointers in *render are valid as long as the document. Errors: ARGUMENT (also a document without view).</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_document_view(msq_document* document, msq_camera* camera, msq_render_def* render);

        /// <summary>Sets the defaults. Errors: ARGUMENT.</summary>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_json_def_init(msq_json_def* def, UIntPtr size);

        /// <summary>Writes a model as a document in JSON: its objects as they were defined, whether by the functions of this header or by a document. msq_document_from_json makes a model of it with the same msq_model_hash, as long as the files that it names are the same. def NULL: defaults.</summary>
        /// <remarks>
        /// <para>Meshes from files are written as the path of the file with its options. Other meshes, and images that no document read from a file, are written as numbers. Objects that are used more than once are written once, under a name.</para>
        /// <para>*bytes: receives the size of the text, without a terminating 0. text: receives it if room is enough, with a terminating 0 if room is larger; NULL if room is 0. Errors: ARGUMENT (also room that is neither 0 nor enough), UNSUPPORTED (an object of the host; beams of more than 4 MiB, whose definition msq does not keep; a path or a name that is not UTF-8; a build without nlohmann-json), LIMIT (max_numbers), MEMORY.</para>
        /// </remarks>
#if NET7_0_OR_GREATER
        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]
        public static partial
#else
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern
#endif
        int msq_model_to_json(msq_model* model, msq_json_def* def, byte* text, ulong room, ulong* bytes);
    }
}
