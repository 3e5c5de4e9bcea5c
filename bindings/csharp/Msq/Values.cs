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
}
