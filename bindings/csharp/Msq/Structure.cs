// SPDX-License-Identifier: Apache-2.0
using System;
using System.Collections.Generic;
using Msq.Interop;

namespace Msq
{
    /// <summary>A foam, beside its grid and radius. What is null has the default of msq.</summary>
    public sealed class FoamOptions
    {
        public FoamMethod Method { get; set; }
        /// <summary>0: seeds at the centres of the cells; 1 (default): anywhere in them.</summary>
        public double? Jitter { get; set; }
        /// <summary>Selects the foam.</summary>
        public long Seed { get; set; }
        /// <summary>Seeds per cell.</summary>
        public Param? Density { get; set; }
        /// <summary>Thickness of the walls between the cells of the foam.</summary>
        public Param? WallThickness { get; set; }
        /// <summary>Radius of the holes in the walls.</summary>
        public Param? VentRadius { get; set; }
        /// <summary>How much longer the cells of the foam are along each axis of the grid.</summary>
        public double[] Stretch { get; set; }
    }

    /// <summary>A functional structure, beside its function and grid.</summary>
    public sealed class FunctionalOptions
    {
        public FunctionalKind Kind { get; set; } = FunctionalKind.Network;
        /// <summary>Value of the function at the surface.</summary>
        public Param? Level { get; set; }
        /// <summary>Sheets: mean thickness of the wall, instead of the level.</summary>
        public Param? Thickness { get; set; }
    }

    /// <summary>A fine structure.</summary>
    public sealed unsafe class Structure : Handle
    {
        private Structure(msq_structure* made) : base(made) { }

        internal msq_structure* In(Call call) => (msq_structure*)call.Use(this, "structure");

        /// <summary>Struts of one of the unit cells of msq.</summary>
        public static Structure Lattice(Context context, UnitCell unitCell, Grid grid, Param radius)
        {
            msq_lattice_def def = msq_lattice_def.Defaults();
            def.unit_cell = (int)unitCell;
            return Lattice(context, def, grid, radius, null, null);
        }

        /// <summary>Struts of a unit cell of the program's own. nodes: in the unit cube. struts: pairs of
        /// indices of nodes.</summary>
        public static Structure Lattice(Context context, Vec3[] nodes, int[] struts, Grid grid, Param radius)
        {
            if (nodes == null) throw new ArgumentNullException(nameof(nodes));
            if (struts == null) throw new ArgumentNullException(nameof(struts));
            if (struts.Length % 2 != 0)
                throw new ArgumentException("struts has " + struts.Length + " indices; it must have two for each",
                                            nameof(struts));
            msq_lattice_def def = msq_lattice_def.Defaults();
            def.unit_cell = (int)UnitCell.Custom;
            def.node_count = (ulong)nodes.Length;
            def.strut_count = (ulong)(struts.Length / 2);
            return Lattice(context, def, grid, radius, nodes, struts);
        }

        private static Structure Lattice(Context context, msq_lattice_def def, Grid grid, Param radius, Vec3[] nodes,
                                         int[] struts)
        {
            Grid.Set(&def.grid, grid);
            using (var call = new Call())
            {
                def.nodes = (double*)call.Pin(nodes);
                def.struts = (uint*)call.Pin(struts);
                def.radius = radius.In(call);
                return From(context, &def);
            }
        }

        /// <summary>The struts of a Voronoi foam, its walls, or both.</summary>
        public static Structure Foam(Context context, Grid grid, Param radius, FoamOptions options = null)
        {
            options = options ?? new FoamOptions();
            msq_foam_def def = msq_foam_def.Defaults();
            Grid.Set(&def.grid, grid);
            def.method = (int)options.Method;
            def.seed = unchecked((ulong)options.Seed);
            if (options.Jitter.HasValue) def.jitter = options.Jitter.Value;
            using (var call = new Call())
            {
                def.radius = radius.In(call);
                if (options.Density.HasValue) def.density = options.Density.Value.In(call);
                if (options.WallThickness.HasValue) def.wall_thickness = options.WallThickness.Value.In(call);
                if (options.VentRadius.HasValue) def.vent_radius = options.VentRadius.Value.In(call);
                if (options.Stretch != null)
                    for (int axis = 0; axis < 3; ++axis) def.stretch[axis] = options.Stretch[axis];
                return From(context, &def);
            }
        }

        /// <summary>A gyroid and the like.</summary>
        public static Structure Functional(Context context, Function function, Grid grid,
                                           FunctionalOptions options = null)
        {
            return Functional(context, function, null, null, grid, options);
        }

        /// <summary>A formula in x, y, z and parameters. x, y and z are angles: they go from 0 to 2 pi
        /// along each axis of a cell of the grid.</summary>
        public static Structure Expression(Context context, string expression, Grid grid,
                                           FunctionalOptions options = null,
                                           IDictionary<string, double> parameters = null)
        {
            if (expression == null) throw new ArgumentNullException(nameof(expression));
            return Functional(context, Function.Expression, expression, parameters, grid, options);
        }

        private static Structure Functional(Context context, Function function, string expression,
                                            IDictionary<string, double> parameters, Grid grid,
                                            FunctionalOptions options)
        {
            options = options ?? new FunctionalOptions();
            msq_functional_def def = msq_functional_def.Defaults();
            Grid.Set(&def.grid, grid);
            def.function = (int)function;
            def.kind = (int)options.Kind;
            using (var call = new Call())
            {
                def.expression = call.Text(expression, nameof(expression));
                def.parameters = Field.NamedValues(call, parameters, out def.parameter_count);
                if (options.Level.HasValue) def.level = options.Level.Value.In(call);
                if (options.Thickness.HasValue) def.thickness = options.Thickness.Value.In(call);
                return From(context, &def);
            }
        }

        /// <summary>A structure that is solid where a function of the program is at most the level. It gets
        /// angles, from 0 to 2 pi along each axis of a cell of the grid. lipschitz bounds its slope in them. concurrent: as for Shape.FromHost.</summary>
        public static Structure FromHost(Context context, Grid grid, Func<Vec3, double> value,
                                         FunctionalOptions options = null,
                                         double lipschitz = double.PositiveInfinity, bool concurrent = false)
        {
            if (value == null) throw new ArgumentNullException(nameof(value));
            options = options ?? new FunctionalOptions();
            if (options.Thickness.HasValue)
                throw new ArgumentException("functions of the program have a level and no thickness", nameof(options));
            msq_host_function_def def = msq_host_function_def.Defaults();
            Grid.Set(&def.grid, grid);
            def.concurrent = Callbacks.Concurrent(context, concurrent);
            def.kind = (int)options.Kind;
            def.lipschitz = lipschitz;
            def.evaluate = Callbacks.Values;
            def.release = Callbacks.Release;
            msq_structure* made;
            using (var call = new Call())
            {
                msq_context* given = call.Use(context);
                if (options.Level.HasValue) def.level = options.Level.Value.In(call);
                def.user = Callbacks.Hold(new Callbacks.Host { Value = value });
                Callbacks.Check(Abi.msq_structure_host_function(given, &def, &made), def.user);
            }
            return new Structure(made);
        }

        /// <summary>By a definition of msq.h. Its pointers must be valid until this returns.</summary>
        public static Structure From(Context context, msq_lattice_def* def)
        {
            msq_structure* made;
            using (var call = new Call()) call.Check(Abi.msq_structure_lattice(call.Use(context), def, &made));
            return new Structure(made);
        }

        /// <summary>By a definition of msq.h. Its pointers must be valid until this returns.</summary>
        public static Structure From(Context context, msq_foam_def* def)
        {
            msq_structure* made;
            using (var call = new Call()) call.Check(Abi.msq_structure_foam(call.Use(context), def, &made));
            return new Structure(made);
        }

        /// <summary>By a definition of msq.h. Its pointers must be valid until this returns.</summary>
        public static Structure From(Context context, msq_functional_def* def)
        {
            msq_structure* made;
            using (var call = new Call()) call.Check(Abi.msq_structure_functional(call.Use(context), def, &made));
            return new Structure(made);
        }

        /// <summary>By a definition of msq.h. Its pointers must be valid until this returns.</summary>
        public static Structure From(Context context, msq_beams_def* def)
        {
            msq_structure* made;
            using (var call = new Call()) call.Check(Abi.msq_structure_beams(call.Use(context), def, &made, null));
            return new Structure(made);
        }

        /// <summary>32 hexadecimal digits, equal for equal structures.</summary>
        public string Hash
        {
            get
            {
                byte* hash = stackalloc byte[16];
                using (var call = new Call()) call.Check(Abi.msq_structure_hash(In(call), hash));
                return Hex(hash);
            }
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_structure_release((msq_structure*)handle);
            return true;
        }
    }
}
