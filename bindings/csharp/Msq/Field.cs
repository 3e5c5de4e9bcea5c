// SPDX-License-Identifier: Apache-2.0
using System;
using System.Collections.Generic;
using System.Threading;
using Msq.Interop;

namespace Msq
{
    /// <summary>A number at each point, for radii, levels, thicknesses and the like.</summary>
    public sealed unsafe class Field : Handle
    {
        private Field(msq_field* made) : base(made) { }

        /// <summary>Linear from one point to another, constant beyond them.</summary>
        public static Field Gradient(Context context, Vec3 from, double fromValue, Vec3 to, double toValue)
        {
            msq_field* made;
            using (var call = new Call())
                call.Check(Abi.msq_field_gradient(call.Use(context), (double*)&from, fromValue, (double*)&to, toValue,
                                                  &made));
            return new Field(made);
        }

        /// <summary>Linear in the distance from a center, or from a line through it along an axis.</summary>
        public static Field Radial(Context context, Vec3 center, double fromRadius, double fromValue, double toRadius,
                                   double toValue, Vec3 axis = default(Vec3))
        {
            msq_radial_field_def def = msq_radial_field_def.Defaults();
            *(Vec3*)def.center = center;
            *(Vec3*)def.axis = axis;
            def.from_radius = fromRadius;
            def.from_value = fromValue;
            def.to_radius = toRadius;
            def.to_value = toValue;
            msq_field* made;
            using (var call = new Call()) call.Check(Abi.msq_field_radial(call.Use(context), &def, &made));
            return new Field(made);
        }

        /// <summary>Samples at origin + (i, j, k) * spacing, x fastest, interpolated linearly along each axis and
        /// constant beyond the border. The values are copied.</summary>
        public static Field Grid(Context context, double[] values, int nx, int ny, int nz, Vec3 origin, Vec3 spacing)
        {
            if (values == null) throw new ArgumentNullException(nameof(values));
            if (nx < 1 || ny < 1 || nz < 1 || (decimal)nx * ny * nz != values.Length)
                throw new ArgumentException("values has " + values.Length + " numbers for " + nx + " x " + ny + " x " +
                                            nz + " samples", nameof(values));
            msq_grid_field_def def = msq_grid_field_def.Defaults();
            def.image.value_type = (int)NumberType.Float64;
            def.image.size[0] = (ulong)nx;
            def.image.size[1] = (ulong)ny;
            def.image.size[2] = (ulong)nz;
            *(Vec3*)def.image.grid.origin = origin;
            *(Vec3*)def.image.grid.cell_size = spacing;
            msq_field* made;
            using (var call = new Call())
            {
                def.image.values = call.Pin(values);
                call.Check(Abi.msq_field_grid(call.Use(context), &def, &made));
            }
            return new Field(made);
        }

        /// <summary>A curve over another field: pairs of an argument and a value, in ascending order.</summary>
        public Field Map(Context context, params Vec2[] curve)
        {
            if (curve == null) throw new ArgumentNullException(nameof(curve));
            msq_field* made;
            using (var call = new Call())
                call.Check(Abi.msq_field_map(call.Use(context), (msq_field*)call.Use(this, "field"),
                                             (double*)call.Pin(curve), (ulong)curve.Length, &made));
            return new Field(made);
        }

        /// <summary>A formula in x, y, z and parameters. low and high bound its values.</summary>
        public static Field Expression(Context context, string expression, double low, double high,
                                       IDictionary<string, double> parameters = null)
        {
            if (expression == null) throw new ArgumentNullException(nameof(expression));
            msq_expression_field_def def = msq_expression_field_def.Defaults();
            def.low = low;
            def.high = high;
            msq_field* made;
            using (var call = new Call())
            {
                def.expression = call.Text(expression, nameof(expression));
                def.parameters = NamedValues(call, parameters, out def.parameter_count);
                call.Check(Abi.msq_field_expression(call.Use(context), &def, &made));
            }
            return new Field(made);
        }

        internal static msq_named_value* NamedValues(Call call, IDictionary<string, double> values, out ulong count)
        {
            count = (ulong)(values?.Count ?? 0);
            if (count == 0) return null;
            // Pairs of a pointer and a double, in an array of words, as arrays of structs with pointers cannot be pinned.
            int words = sizeof(msq_named_value) / sizeof(long);
            var found = (msq_named_value*)call.Pin(new long[(int)count * words]);
            int i = 0;
            foreach (KeyValuePair<string, double> one in values)
                found[i++] = new msq_named_value { name = call.Text(one.Key, "parameters"), value = one.Value };
            return found;
        }

        /// <summary>The distance to the boundary of a shape, negative inside, through a curve: pairs of a
        /// distance and a value, in ascending order. step: spacing of samples that are interpolated; 0: the exact
        /// distance at each point.</summary>
        public static Field ShapeDistance(Context context, Shape shape, Vec2[] curve, double step = 0,
                                          CancellationToken cancel = default(CancellationToken),
                                          IProgress<double> progress = null)
        {
            if (shape == null) throw new ArgumentNullException(nameof(shape));
            msq_shape_distance_field_def def = msq_shape_distance_field_def.Defaults();
            def.step = step;
            def.curve_count = (ulong)(curve?.Length ?? 0);
            msq_field* made;
            using (var call = new Call(cancel, progress))
            {
                def.shape = shape.In(call);
                def.curve = (double*)call.Pin(curve);
                call.Check(Abi.msq_field_shape_distance(call.Use(context), &def, &made, call.Job));
                return call.Done(new Field(made));
            }
        }

        /// <summary>A field that the program computes. low and high bound its values; lipschitz bounds its
        /// slope. concurrent: as for Shape.FromHost.</summary>
        public static Field FromHost(Context context, Func<Vec3, double> value, double low, double high,
                                     double lipschitz = double.PositiveInfinity, bool concurrent = false)
        {
            if (value == null) throw new ArgumentNullException(nameof(value));
            msq_host_field_def def = msq_host_field_def.Defaults();
            def.concurrent = Callbacks.Concurrent(context, concurrent);
            def.low = low;
            def.high = high;
            def.lipschitz = lipschitz;
            def.evaluate = Callbacks.Values;
            def.release = Callbacks.Release;
            msq_field* made;
            using (var call = new Call())
            {
                msq_context* given = call.Use(context);
                def.user = Callbacks.Hold(new Callbacks.Host { Value = value });
                Callbacks.Check(Abi.msq_field_host(given, &def, &made), def.user);
            }
            return new Field(made);
        }

        /// <summary>32 hexadecimal digits, equal for equal fields.</summary>
        public string Hash
        {
            get
            {
                byte* hash = stackalloc byte[16];
                using (var call = new Call())
                    call.Check(Abi.msq_field_hash((msq_field*)call.Use(this, "field"), hash));
                return Hex(hash);
            }
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_field_release((msq_field*)handle);
            return true;
        }
    }
}
