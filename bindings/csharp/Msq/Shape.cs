// SPDX-License-Identifier: Apache-2.0
using System;
using System.Threading;
using Msq.Interop;

namespace Msq
{
    /// <summary>How a mesh file is read.</summary>
    public sealed class FileOptions
    {
        public Format Format { get; set; }
        public Winding Winding { get; set; } = Winding.Auto;
        /// <summary>Length of the file's unit in mm, for formats that name none.</summary>
        public double UnitMm { get; set; } = 1;

        internal msq_file_def Raw()
        {
            msq_file_def def = msq_file_def.Defaults();
            def.format = (int)Format;
            def.winding_rule = (int)Winding;
            def.unit_mm = UnitMm;
            return def;
        }
    }

    /// <summary>A coarse solid.</summary>
    public sealed unsafe class Shape : Handle
    {
        internal Shape(msq_shape* made) : base(made) { }

        internal msq_shape* In(Call call, string name = "shape") => (msq_shape*)call.Use(this, name);

        public static Shape Box(Context context, Vec3 min, Vec3 max)
        {
            msq_shape* made;
            using (var call = new Call())
                call.Check(Abi.msq_shape_from_box(call.Use(context), (double*)&min, (double*)&max, &made));
            return new Shape(made);
        }

        public static Shape Sphere(Context context, Vec3 center, double radius)
        {
            msq_shape* made;
            using (var call = new Call())
                call.Check(Abi.msq_shape_from_sphere(call.Use(context), (double*)&center, radius, &made));
            return new Shape(made);
        }

        public static Shape Cylinder(Context context, Vec3 from, Vec3 to, double radius)
        {
            msq_shape* made;
            using (var call = new Call())
                call.Check(Abi.msq_shape_from_cylinder(call.Use(context), (double*)&from, (double*)&to, radius, &made));
            return new Shape(made);
        }

        public static Shape AllSpace(Context context)
        {
            msq_shape* made;
            using (var call = new Call()) call.Check(Abi.msq_shape_all_space(call.Use(context), &made));
            return new Shape(made);
        }

        /// <summary>Reads a mesh file, in millimetres.</summary>
        public static Shape FromFile(Context context, string path, FileOptions options = null,
                                     CancellationToken cancel = default(CancellationToken),
                                     IProgress<double> progress = null)
        {
            if (path == null) throw new ArgumentNullException(nameof(path));
            msq_file_def def = (options ?? new FileOptions()).Raw();
            msq_shape* made;
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_shape_from_file(call.Use(context), call.Text(path, nameof(path)), &def, &made,
                                                   call.Job));
                return call.Done(new Shape(made));
            }
        }

        /// <summary>Reads the bytes of a mesh file. The options name its format.</summary>
        public static Shape FromMemory(Context context, byte[] data, FileOptions options,
                                       CancellationToken cancel = default(CancellationToken),
                                       IProgress<double> progress = null)
        {
            if (data == null) throw new ArgumentNullException(nameof(data));
            if (options == null) throw new ArgumentNullException(nameof(options));
            msq_file_def def = options.Raw();
            msq_shape* made;
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_shape_from_memory(call.Use(context), call.Pin(data), (ulong)data.Length, &def,
                                                     &made, call.Job));
                return call.Done(new Shape(made));
            }
        }

        /// <summary>triangles: triples of indices of vertices, counter-clockwise seen from outside.</summary>
        public static Shape FromMesh(Context context, Vec3[] vertices, int[] triangles, Winding winding = Winding.Auto)
        {
            if (vertices == null) throw new ArgumentNullException(nameof(vertices));
            return FromMesh(context, vertices, vertices.Length, NumberType.Float64, triangles, winding);
        }

        /// <summary>vertices: triples x, y, z.</summary>
        public static Shape FromMesh(Context context, double[] vertices, int[] triangles, Winding winding = Winding.Auto)
        {
            return FromMesh(context, vertices, Triples(vertices, nameof(vertices)), NumberType.Float64, triangles,
                            winding);
        }

        /// <summary>vertices: triples x, y, z.</summary>
        public static Shape FromMesh(Context context, float[] vertices, int[] triangles, Winding winding = Winding.Auto)
        {
            return FromMesh(context, vertices, Triples(vertices, nameof(vertices)), NumberType.Float32, triangles,
                            winding);
        }

        private static Shape FromMesh(Context context, Array vertices, int count, NumberType type, int[] triangles,
                                      Winding winding)
        {
            msq_mesh_def def = msq_mesh_def.Defaults();
            def.triangle_count = (ulong)Triples(triangles, nameof(triangles));
            def.vertex_count = (ulong)count;
            def.coordinate_type = (int)type;
            def.winding_rule = (int)winding;
            msq_shape* made;
            using (var call = new Call())
            {
                def.vertices = call.Pin(vertices);
                def.triangles = (uint*)call.Pin(triangles);
                call.Check(Abi.msq_shape_from_mesh(call.Use(context), &def, &made));
            }
            return new Shape(made);
        }

        /// <summary>The number of triples in an array.</summary>
        internal static int Triples(Array array, string name)
        {
            if (array == null) throw new ArgumentNullException(name);
            if (array.Length % 3 != 0)
                throw new ArgumentException(name + " has " + array.Length + " numbers; it must have three for each",
                                            name);
            return array.Length / 3;
        }

        /// <summary>A shape that the program computes. inside: membership of points within the box. distance:
        /// a lower bound of the distance to the boundary, or null. concurrent: threads of msq call both, at the
        /// same time, on Mono only those of UseThreadPool; otherwise the thread that calls msq does, and computes
        /// models with this shape alone.</summary>
        public static Shape FromHost(Context context, Vec3 min, Vec3 max, Func<Vec3, bool> inside,
                                     Func<Vec3, double> distance = null, bool concurrent = false)
        {
            if (inside == null) throw new ArgumentNullException(nameof(inside));
            msq_host_shape_def def = msq_host_shape_def.Defaults();
            def.concurrent = Callbacks.Concurrent(context, concurrent);
            *(Vec3*)def.min = min;
            *(Vec3*)def.max = max;
            def.inside = Callbacks.Inside;
            if (distance != null) def.distance = Callbacks.Values;
            def.release = Callbacks.Release;
            msq_shape* made;
            using (var call = new Call())
            {
                msq_context* given = call.Use(context);
                def.user = Callbacks.Hold(new Callbacks.Host { Inside = inside, Value = distance });
                Callbacks.Check(Abi.msq_shape_from_host(given, &def, &made), def.user);
            }
            return new Shape(made);
        }

        /// <summary>The shape, moved by a matrix: three rows of four numbers.</summary>
        public Shape Placed(double[] matrix)
        {
            if (matrix == null) throw new ArgumentNullException(nameof(matrix));
            if (matrix.Length != 12)
                throw new ArgumentException("matrix has " + matrix.Length + " numbers; it must have 12", nameof(matrix));
            msq_shape* made;
            using (var call = new Call())
                call.Check(Abi.msq_shape_placed(In(call), (double*)call.Pin(matrix), &made));
            return new Shape(made);
        }

        /// <summary>The shape, larger by a distance, or smaller by a negative one.</summary>
        public Shape Offset(double distance)
        {
            msq_shape* made;
            using (var call = new Call()) call.Check(Abi.msq_shape_offset(In(call), distance, &made));
            return new Shape(made);
        }

        public static Shape Union(params Shape[] shapes) => Combine(BooleanOperation.Union, shapes);
        public static Shape Intersection(params Shape[] shapes) => Combine(BooleanOperation.Intersection, shapes);
        /// <summary>The first without the others.</summary>
        public static Shape Difference(params Shape[] shapes) => Combine(BooleanOperation.Difference, shapes);

        private static Shape Combine(BooleanOperation operation, Shape[] shapes)
        {
            if (shapes == null) throw new ArgumentNullException(nameof(shapes));
            var pointers = new IntPtr[shapes.Length];
            msq_shape* made;
            using (var call = new Call())
            {
                for (int i = 0; i < shapes.Length; ++i) pointers[i] = (IntPtr)call.Use(shapes[i], nameof(shapes));
                call.Check(Abi.msq_shape_boolean((int)operation, (msq_shape**)call.Pin(pointers),
                                                 (ulong)pointers.Length, &made));
            }
            return new Shape(made);
        }

        private msq_shape_report Info()
        {
            var report = new msq_shape_report { struct_size = (uint)sizeof(msq_shape_report) };
            using (var call = new Call()) call.Check(Abi.msq_shape_info(In(call), &report));
            return report;
        }

        /// <summary>Corners of the bounding box.</summary>
        public Vec3 Min
        {
            get
            {
                msq_shape_report info = Info();
                return *(Vec3*)info.min;
            }
        }

        public Vec3 Max
        {
            get
            {
                msq_shape_report info = Info();
                return *(Vec3*)info.max;
            }
        }

        /// <summary>Number of triangles of a mesh; 0 of other shapes.</summary>
        public long TriangleCount => (long)Info().triangles;
        /// <summary>Edges of a mesh without a second triangle.</summary>
        public long OpenEdgeCount => (long)Info().open_edges;

        /// <summary>32 hexadecimal digits, equal for equal shapes.</summary>
        public string Hash
        {
            get
            {
                byte* hash = stackalloc byte[16];
                using (var call = new Call()) call.Check(Abi.msq_shape_hash(In(call), hash));
                return Hex(hash);
            }
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_shape_release((msq_shape*)handle);
            return true;
        }
    }
}
