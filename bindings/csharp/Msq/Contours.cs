// SPDX-License-Identifier: Apache-2.0
using System;
using System.Collections.Generic;
using Msq.Interop;

namespace Msq
{
    /// <summary>How contours are made.</summary>
    public sealed class ContoursOptions
    {
        /// <summary>tolerance: greatest distance between boundary and rings.</summary>
        public ContoursOptions(double tolerance) { Tolerance = tolerance; }

        public double Tolerance { get; }
        /// <summary>Distance of the samples; 0: the tolerance.</summary>
        public double Pitch { get; set; }
        /// <summary>Normal of the plane: 0 (x), 1 (y) or 2 (z). Of slicers: 2.</summary>
        public int Axis { get; set; } = 2;

        internal msq_contours_def Raw()
        {
            msq_contours_def def = msq_contours_def.Defaults();
            def.tolerance = Tolerance;
            def.pitch = Pitch;
            def.axis = Axis;
            return def;
        }
    }

    /// <summary>A closed line; its first point is not repeated.</summary>
    public sealed class Ring
    {
        internal Ring(Vec2[] points, bool isHole, int parent)
        {
            Points = points;
            IsHole = isHole;
            Parent = parent;
        }

        /// <summary>Counter-clockwise; of holes clockwise.</summary>
        public Vec2[] Points { get; }
        public bool IsHole { get; }
        /// <summary>The index of the ring just around this one; -1: none.</summary>
        public int Parent { get; }
    }

    /// <summary>The section of a model with a plane.</summary>
    public sealed unsafe class Contours : Handle
    {
        internal Contours(msq_contours* made) : base(made) { }

        private msq_contours_report Info(Call call)
        {
            var report = new msq_contours_report { struct_size = (uint)sizeof(msq_contours_report) };
            call.Check(Abi.msq_contours_info((msq_contours*)call.Use(this, "contours"), &report));
            return report;
        }

        public int Count
        {
            get { using (var call = new Call()) return checked((int)Info(call).ring_count); }
        }

        /// <summary>Places where rings may be wrong at the scale of the pitch.</summary>
        public long UnresolvedCount
        {
            get { using (var call = new Call()) return (long)Info(call).unresolved_count; }
        }

        /// <summary>All rings, copied. A parent has a smaller index than its children.</summary>
        public IList<Ring> Rings()
        {
            using (var call = new Call())
            {
                msq_contours_report info = Info(call);
                var rings = new Ring[checked((int)info.ring_count)];
                for (int i = 0; i < rings.Length; ++i)
                {
                    var points = new Vec2[checked((int)(info.starts[i + 1] - info.starts[i]))];
                    for (int j = 0; j < points.Length; ++j) points[j] = Point(info, info.starts[i] + (ulong)j);
                    rings[i] = new Ring(points, info.holes[i] != 0, (int)info.parents[i]);
                }
                return rings;
            }
        }

        // Contours of a document may be in integers.
        private static Vec2 Point(msq_contours_report info, ulong index)
        {
            switch ((NumberType)info.type)
            {
                case NumberType.Int32:
                    return new Vec2(((int*)info.points)[2 * index], ((int*)info.points)[2 * index + 1]);
                case NumberType.Int64:
                    return new Vec2(((long*)info.points)[2 * index], ((long*)info.points)[2 * index + 1]);
                default:
                    return ((Vec2*)info.points)[index];
            }
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_contours_release((msq_contours*)handle);
            return true;
        }
    }
}
