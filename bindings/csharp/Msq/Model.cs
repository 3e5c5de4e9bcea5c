// SPDX-License-Identifier: Apache-2.0
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Threading;
using Msq.Interop;

namespace Msq
{
    /// <summary>A structure in a model. A structure converts to it.</summary>
    public sealed class Scale
    {
        public Scale(Structure structure, Param skin = default(Param))
        {
            Structure = structure;
            Skin = skin;
        }

        public Structure Structure { get; }
        /// <summary>Thickness of the solid skin that the structure leaves under the surface of the shape.</summary>
        public Param Skin { get; }

        public static implicit operator Scale(Structure structure) => new Scale(structure);
    }

    /// <summary>Where a ray first meets the solid.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct RayHit
    {
        // The members of msq_ray_hit.
        private readonly double t;
        private readonly Vec3 normal;
        private readonly int scale, startsInside, cellX, cellY, cellZ;
        private readonly uint material;

        public bool IsHit => !double.IsPositiveInfinity(t);
        /// <summary>The point is origin + T * direction. Infinity without a hit.</summary>
        public double T => t;
        /// <summary>Outward, of length 1. 0 without a hit.</summary>
        public Vec3 Normal => normal;
        /// <summary>The scale that was hit: 0 for the shape; -1 without a hit.</summary>
        public int Scale => scale;
        /// <summary>Whether the ray starts in the solid.</summary>
        public bool StartsInside => startsInside != 0;
        /// <summary>The cell of the finest structure at the point.</summary>
        public int CellX => cellX;
        public int CellY => cellY;
        public int CellZ => cellZ;
        /// <summary>Material id just inside.</summary>
        public int Material => (int)material;
    }

    /// <summary>Triangles.</summary>
    public sealed class Mesh
    {
        internal Mesh(Vec3[] vertices, float[] normals, int[] triangles)
        {
            Vertices = vertices;
            Normals = normals;
            Triangles = triangles;
        }

        public Vec3[] Vertices { get; }
        /// <summary>Three numbers for each vertex.</summary>
        public float[] Normals { get; }
        /// <summary>Triples of indices of vertices, counter-clockwise seen from outside.</summary>
        public int[] Triangles { get; }
    }

    /// <summary>Collects the slabs of a mesh.</summary>
    internal sealed unsafe class MeshParts
    {
        private readonly List<Vec3> vertices = new List<Vec3>();
        private readonly List<float> normals = new List<float>();
        private readonly List<int> triangles = new List<int>();

        internal void Add(msq_surface_slab* slab)
        {
            for (ulong i = 0; i < slab->vertex_count; ++i) vertices.Add(((Vec3*)slab->vertices)[i]);
            for (ulong i = 0; i < 3 * slab->vertex_count; ++i) normals.Add(slab->normals[i]);
            for (ulong i = 0; i < 3 * slab->triangle_count; ++i) triangles.Add(checked((int)slab->triangles[i]));
        }

        internal Mesh Mesh => new Mesh(vertices.ToArray(), normals.ToArray(), triangles.ToArray());
    }

    /// <summary>A shape, filled with structures from coarse to fine.</summary>
    public sealed unsafe class Model : Handle
    {
        internal Model(msq_model* made) : base(made) { }

        /// <summary>scales: Structures or Scales, coarse ones first; none for the shape alone.</summary>
        public Model(Context context, Shape shape, params Scale[] scales) : base(Create(context, shape, scales)) { }

        private static msq_model* Create(Context context, Shape shape, Scale[] given)
        {
            if (shape == null) throw new ArgumentNullException(nameof(shape));
            if (given == null) throw new ArgumentNullException("scales");
            msq_model_def def = msq_model_def.Defaults();
            msq_model* made;
            using (var call = new Call())
            {
                // In an array of words: arrays of structs with pointers cannot be pinned.
                int words = sizeof(msq_scale_def) / sizeof(long);
                var scales = (msq_scale_def*)call.Pin(new long[(given.Length + 1) * words]);
                scales[0].shape = shape.In(call);
                for (int i = 0; i < given.Length; ++i)
                {
                    if (given[i] == null || given[i].Structure == null)
                        throw new ArgumentNullException("scales", "scale " + (i + 1) + " is null");
                    scales[i + 1].structure = given[i].Structure.In(call);
                    scales[i + 1].skin = given[i].Skin.In(call);
                }
                def.scales = scales;
                def.scale_count = (uint)(given.Length + 1);
                def.scale_size = (uint)sizeof(msq_scale_def);
                call.Check(Abi.msq_model_create(call.Use(context), &def, &made));
            }
            return made;
        }

        /// <summary>Models in order of priority: a point belongs to the first whose shape contains it.</summary>
        public static Model Regions(Context context, params Model[] models)
        {
            if (models == null) throw new ArgumentNullException(nameof(models));
            var pointers = new IntPtr[models.Length];
            msq_model* made;
            using (var call = new Call())
            {
                for (int i = 0; i < models.Length; ++i) pointers[i] = (IntPtr)call.Use(models[i], nameof(models));
                call.Check(Abi.msq_model_regions(call.Use(context), (msq_model**)call.Pin(pointers),
                                                 (ulong)pointers.Length, &made));
            }
            return new Model(made);
        }

        internal msq_model* In(Call call) => (msq_model*)call.Use(this, "model");

        /// <summary>32 hexadecimal digits, equal for equal models.</summary>
        public string Hash
        {
            get
            {
                byte* hash = stackalloc byte[16];
                using (var call = new Call()) call.Check(Abi.msq_model_hash(In(call), hash));
                return Hex(hash);
            }
        }

        /// <summary>Corners of the bounding box of the shape.</summary>
        public void Bounds(out Vec3 min, out Vec3 max)
        {
            Vec3 low, high;
            using (var call = new Call()) call.Check(Abi.msq_model_bounds(In(call), (double*)&low, (double*)&high));
            min = low;
            max = high;
        }

        /// <summary>Whether a point is in the solid.</summary>
        public bool Contains(Vec3 point)
        {
            int inside;
            using (var call = new Call())
                call.Check(Abi.msq_point_membership(In(call), (double*)&point, null, &inside));
            return inside != 0;
        }

        /// <summary>Whether each point is in the solid.</summary>
        public bool[] Membership(Vec3[] points, CancellationToken cancel = default(CancellationToken),
                                 IProgress<double> progress = null)
        {
            if (points == null) throw new ArgumentNullException(nameof(points));
            var found = new bool[points.Length];
            fixed (Vec3* first = points)
            fixed (bool* inside = found)
                Membership((double*)first, points.Length, inside, cancel, progress);
            return found;
        }

        /// <summary>The same for triples x, y, z.</summary>
        public bool[] Membership(double[] triples, CancellationToken cancel = default(CancellationToken),
                                 IProgress<double> progress = null)
        {
            var found = new bool[Shape.Triples(triples, nameof(triples))];
            fixed (double* first = triples)
            fixed (bool* inside = found)
                Membership(first, found.Length, inside, cancel, progress);
            return found;
        }

        /// <summary>The points origin + (i, j, k) * spacing, x fastest.</summary>
        public bool[] GridMembership(Vec3 origin, Vec3 spacing, int countX, int countY, int countZ,
                                     CancellationToken cancel = default(CancellationToken),
                                     IProgress<double> progress = null)
        {
            if (countX < 1 || countY < 1 || countZ < 1)
                throw new ArgumentException("a grid of " + countX + " x " + countY + " x " + countZ + " points");
            var found = new bool[checked(countX * countY * countZ)];
            msq_points_def points = msq_points_def.Defaults();
            points.kind = (int)PointsKind.Grid;
            *(Vec3*)points.origin = origin;
            *(Vec3*)points.spacing = spacing;
            points.counts[0] = (ulong)countX;
            points.counts[1] = (ulong)countY;
            points.counts[2] = (ulong)countZ;
            fixed (bool* inside = found)
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_set_membership(In(call), &points, null, (byte*)inside, (ulong)found.Length,
                                                  call.Job));
                return call.Done(found);
            }
        }

        /// <summary>Signed distances to the surface, positive outside, never too large in magnitude.</summary>
        public double[] Distance(Vec3[] points, CancellationToken cancel = default(CancellationToken),
                                 IProgress<double> progress = null)
        {
            if (points == null) throw new ArgumentNullException(nameof(points));
            var found = new double[points.Length];
            fixed (Vec3* first = points)
            fixed (double* distances = found)
                Distance((double*)first, points.Length, distances, cancel, progress);
            return found;
        }

        /// <summary>The same for triples x, y, z.</summary>
        public double[] Distance(double[] triples, CancellationToken cancel = default(CancellationToken),
                                 IProgress<double> progress = null)
        {
            var found = new double[Shape.Triples(triples, nameof(triples))];
            fixed (double* first = triples)
            fixed (double* distances = found)
                Distance(first, found.Length, distances, cancel, progress);
            return found;
        }

#if MSQ_SPAN || NETCOREAPP2_1_OR_GREATER || NETSTANDARD2_1_OR_GREATER
        /// <summary>For triples x, y, z, into memory of the caller: one value for each.</summary>
        public void Membership(ReadOnlySpan<double> triples, Span<bool> inside,
                               CancellationToken cancel = default(CancellationToken),
                               IProgress<double> progress = null)
        {
            CheckSpans(triples.Length, inside.Length, nameof(inside));
            fixed (double* first = &MemoryMarshal.GetReference(triples))
            fixed (bool* target = &MemoryMarshal.GetReference(inside))
                Membership(first, inside.Length, target, cancel, progress);
        }

        /// <summary>For triples x, y, z, into memory of the caller: one value for each.</summary>
        public void Distance(ReadOnlySpan<double> triples, Span<double> distances,
                             CancellationToken cancel = default(CancellationToken),
                             IProgress<double> progress = null)
        {
            CheckSpans(triples.Length, distances.Length, nameof(distances));
            fixed (double* first = &MemoryMarshal.GetReference(triples))
            fixed (double* target = &MemoryMarshal.GetReference(distances))
                Distance(first, distances.Length, target, cancel, progress);
        }

        private static void CheckSpans(int numbers, int count, string name)
        {
            if (numbers != 3L * count)
                throw new ArgumentException(name + " has " + count + " elements for " + numbers +
                                            " coordinates; it must have one for three", name);
        }
#endif

        private static msq_points_def Points(double* triples, int count)
        {
            msq_points_def points = msq_points_def.Defaults();
            points.kind = (int)PointsKind.Array;
            points.coordinate_type = (int)NumberType.Float64;
            points.coordinates = triples;
            points.count = (ulong)count;
            return points;
        }

        private void Membership(double* triples, int count, bool* inside, CancellationToken cancel,
                                IProgress<double> progress)
        {
            msq_points_def points = Points(triples, count);
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_set_membership(In(call), &points, null, (byte*)inside, (ulong)count, call.Job));
                call.Done(count);
            }
        }

        private void Distance(double* triples, int count, double* distances, CancellationToken cancel,
                              IProgress<double> progress)
        {
            msq_points_def points = Points(triples, count);
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_set_distance(In(call), &points, null, distances, (ulong)count, call.Job));
                call.Done(count);
            }
        }

        /// <summary>Where each ray, origin + t * direction with 0 &lt;= t &lt;= maxT, first meets the solid.</summary>
        public RayHit[] CastRays(Vec3[] origins, Vec3[] directions, double maxT = double.PositiveInfinity,
                                 CancellationToken cancel = default(CancellationToken),
                                 IProgress<double> progress = null)
        {
            if (origins == null) throw new ArgumentNullException(nameof(origins));
            if (directions == null) throw new ArgumentNullException(nameof(directions));
            if (origins.Length != directions.Length)
                throw new ArgumentException(directions.Length + " directions for " + origins.Length + " origins",
                                            nameof(directions));
            var found = new RayHit[origins.Length];
            msq_rays_def rays = msq_rays_def.Defaults();
            rays.count = (ulong)origins.Length;
            double[] ends = null;
            if (!double.IsPositiveInfinity(maxT))
            {
                ends = new double[origins.Length];
                for (int i = 0; i < ends.Length; ++i) ends[i] = maxT;
            }
            using (var call = new Call(cancel, progress))
            fixed (RayHit* hits = found)
            {
                rays.origins = call.Pin(origins);
                rays.directions = call.Pin(directions);
                rays.t_max = (double*)call.Pin(ends);
                call.Check(Abi.msq_ray_cast(In(call), &rays, null, (msq_ray_hit*)hits, (ulong)found.Length, call.Job));
                return call.Done(found);
            }
        }

        /// <summary>The section with the plane at a height along an axis.</summary>
        public Contours Contours(double height, ContoursOptions options,
                                 CancellationToken cancel = default(CancellationToken),
                                 IProgress<double> progress = null)
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            msq_contours_def def = options.Raw();
            msq_contours* made;
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_layer_contours(In(call), height, &def, &made, call.Job));
                return call.Done(new Contours(made));
            }
        }

        /// <summary>Triangles of the boundary, a closed manifold, from samples at the pitch.</summary>
        public Mesh Mesh(double pitch, CancellationToken cancel = default(CancellationToken),
                         IProgress<double> progress = null)
        {
            msq_surface_def def = msq_surface_def.Defaults();
            def.pitch = pitch;
            return Mesh(def, cancel, progress);
        }

        /// <summary>Triangles of the boundary of the part in a box.</summary>
        public Mesh Mesh(double pitch, Vec3 min, Vec3 max, CancellationToken cancel = default(CancellationToken),
                         IProgress<double> progress = null)
        {
            msq_surface_def def = msq_surface_def.Defaults();
            def.pitch = pitch;
            def.has_box = 1;
            *(Vec3*)def.min = min;
            *(Vec3*)def.max = max;
            return Mesh(def, cancel, progress);
        }

        private Mesh Mesh(msq_surface_def def, CancellationToken cancel, IProgress<double> progress)
        {
            var parts = new MeshParts();
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_surface_mesh(In(call), &def, Callbacks.Slab, call.User(parts), call.Job));
                return call.Done(parts.Mesh);
            }
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_model_release((msq_model*)handle);
            return true;
        }
    }
}
