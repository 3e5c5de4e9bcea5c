// SPDX-License-Identifier: Apache-2.0
using System;
using System.Globalization;
using System.Runtime.InteropServices;
using Msq.Interop;

namespace Msq
{
    /// <summary>A point or a vector: three doubles, as Rhino's Point3d has them.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vec3 : IEquatable<Vec3>
    {
        public double X, Y, Z;

        public Vec3(double x, double y, double z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        public bool Equals(Vec3 other) => X.Equals(other.X) && Y.Equals(other.Y) && Z.Equals(other.Z);
        public override bool Equals(object other) => other is Vec3 && Equals((Vec3)other);
        public override int GetHashCode() => X.GetHashCode() * 31 * 31 + Y.GetHashCode() * 31 + Z.GetHashCode();
        public override string ToString() =>
            string.Format(CultureInfo.InvariantCulture, "({0}, {1}, {2})", X, Y, Z);
    }

    /// <summary>A point of a plane.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vec2
    {
        public double X, Y;

        public Vec2(double x, double y)
        {
            X = x;
            Y = y;
        }

        public override string ToString() => string.Format(CultureInfo.InvariantCulture, "({0}, {1})", X, Y);
    }

    /// <summary>A number, or a field that gives one at each point. Both convert to it.</summary>
    public struct Param
    {
        private readonly double value;
        private readonly Field field;

        private Param(double value, Field field)
        {
            this.value = value;
            this.field = field;
        }

        public static implicit operator Param(double value) => new Param(value, null);
        public static implicit operator Param(Field field) => new Param(0, field);

        internal unsafe msq_param In(Call call) => new msq_param
        { value = value, field = field == null ? null : (msq_field*)call.Use(field, "field") };
    }

    /// <summary>The grid of cells of a structure. A number converts to a grid of cubes of that size.</summary>
    public sealed class Grid
    {
        private readonly double[] rotation;

        /// <summary>rotation: nine numbers, row by row; null for none.</summary>
        public Grid(Vec3 cellSize, Vec3 origin = default(Vec3), double[] rotation = null)
        {
            if (rotation != null && rotation.Length != 9)
                throw new ArgumentException("rotation has " + rotation.Length + " numbers; it must have 9",
                                            nameof(rotation));
            CellSize = cellSize;
            Origin = origin;
            this.rotation = (double[])rotation?.Clone();
        }

        public Vec3 CellSize { get; }
        public Vec3 Origin { get; }

        public static implicit operator Grid(double cellSize) => new Grid(new Vec3(cellSize, cellSize, cellSize));

        internal static unsafe void Set(msq_neighbourhood* grid, Grid value)
        {
            if (value == null) throw new ArgumentNullException("grid");
            *(Vec3*)grid->origin = value.Origin;
            *(Vec3*)grid->cell_size = value.CellSize;
            for (int i = 0; value.rotation != null && i < 9; ++i) grid->rotation[i] = value.rotation[i];
        }
    }

    /// <summary>Cells whose size varies along one axis of the grid; the grid's own cell size along this axis is
    /// ignored. The number of cells per unit length is linear between positions and constant beyond them.</summary>
    public sealed class Period
    {
        private readonly double[] positions, cellSizes;
        private readonly int axis;

        /// <summary>positions: coordinates along the axis, from the origin of the grid, in ascending order.
        /// cellSizes: the size of the cells at each. axis: 0 to 2.</summary>
        public Period(double[] positions, double[] cellSizes, int axis = 2)
        {
            if (positions == null) throw new ArgumentNullException(nameof(positions));
            if (cellSizes == null) throw new ArgumentNullException(nameof(cellSizes));
            if (positions.Length != cellSizes.Length)
                throw new ArgumentException("cellSizes has " + cellSizes.Length + " numbers; it must have " +
                                            positions.Length + ", one for each position", nameof(cellSizes));
            this.positions = (double[])positions.Clone();
            this.cellSizes = (double[])cellSizes.Clone();
            this.axis = axis;
        }

        /// <summary>Valid until the call is over. null of none.</summary>
        internal static unsafe msq_period_def* In(Call call, Period value)
        {
            if (value == null) return null;
            msq_period_def def = msq_period_def.Defaults();
            def.axis = value.axis;
            def.positions = (double*)call.Pin(value.positions);
            def.cell_sizes = (double*)call.Pin(value.cellSizes);
            def.count = (ulong)value.positions.Length;
            // In an array of words, as structs with pointers cannot be pinned.
            var kept = (msq_period_def*)call.Pin(new long[(sizeof(msq_period_def) + 7) / 8]);
            *kept = def;
            return kept;
        }
    }

    /// <summary>Cells around the z axis of the grid, around its origin, or by a map of samples. The first cell size of
    /// the grid is that outwards.</summary>
    public sealed class Warp
    {
        /// <summary>count: cells in a whole turn. outerRadius 0: no limit. countPolar: null for cells around the
        /// axis; otherwise the cells from pole to pole, around the origin. shearOutwards, shearAlong: around the axis,
        /// the cells around that the pattern turns by from cell to cell outwards and along the axis.</summary>
        public Warp(uint count, double innerRadius = 0, double outerRadius = 0, uint? countPolar = null,
                    double shearOutwards = 0, double shearAlong = 0)
        {
            ShearOutwards = shearOutwards;
            ShearAlong = shearAlong;
            Count = count;
            InnerRadius = innerRadius;
            OuterRadius = outerRadius;
            CountPolar = countPolar;
        }

        private readonly Field[] map;

        private Warp(Field[] map) { this.map = map; }

        /// <summary>Cells by a map: fields of samples (Field.Grid) on one grid give the coordinates of cells at a
        /// point.</summary>
        public static Warp Sampled(Field u, Field v, Field w)
        {
            if (u == null) throw new ArgumentNullException(nameof(u));
            if (v == null) throw new ArgumentNullException(nameof(v));
            if (w == null) throw new ArgumentNullException(nameof(w));
            return new Warp(new[] { u, v, w });
        }

        public uint Count { get; }
        public double ShearOutwards { get; }
        public double ShearAlong { get; }
        public uint? CountPolar { get; }
        public double InnerRadius { get; }
        public double OuterRadius { get; }

        /// <summary>Valid until the call is over. null of none.</summary>
        internal static unsafe msq_warp_def* In(Call call, Warp value)
        {
            if (value == null) return null;
            var kept = (msq_warp_def*)call.Pin(new long[(sizeof(msq_warp_def) + 7) / 8]);
            *kept = msq_warp_def.Defaults();
            if (value.map != null)
            {
                kept->kind = (int)WarpKind.Sampled;
                kept->u = (msq_field*)call.Use(value.map[0], "u");
                kept->v = (msq_field*)call.Use(value.map[1], "v");
                kept->w = (msq_field*)call.Use(value.map[2], "w");
                return kept;
            }
            kept->kind = (int)(value.CountPolar.HasValue ? WarpKind.Spherical : WarpKind.Cylindrical);
            kept->count = value.Count;
            kept->count_polar = value.CountPolar ?? 0;
            kept->inner_radius = value.InnerRadius;
            kept->outer_radius = value.OuterRadius;
            kept->shear_outwards = value.ShearOutwards;
            kept->shear_along = value.ShearAlong;
            return kept;
        }
    }
}
