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
        /// <summary>How much longer the cells of the foam are along each axis of the grid: three numbers.</summary>
        public double[] Stretch { get; set; }
        /// <summary>The greatest radius of the seeds' spheres; above 0, cells are those of a Laguerre
        /// tessellation.</summary>
        public double Weight { get; set; }
        /// <summary>Cells of varying size.</summary>
        public Period Period { get; set; }
        /// <summary>Cells around an axis or a point, or by a map.</summary>
        public Warp Warp { get; set; }
    }

    /// <summary>A lattice, beside its unit cell, grid and radius. null: all cells are boxes of one size.</summary>
    public sealed class LatticeOptions
    {
        public Period Period { get; set; }
        public Warp Warp { get; set; }
    }

    /// <summary>A lattice of plates, beside its unit cell, grid and thickness.</summary>
    public sealed class PlateLatticeOptions
    {
        /// <summary>Factor of the thickness for each triangle of the unit cell; null for 1.</summary>
        public double[] FaceFactors { get; set; }
        /// <summary>Radius of struts in the same cells; null for none.</summary>
        public Param? Radius { get; set; }
        /// <summary>Unit cell of the struts.</summary>
        public UnitCell UnitCell { get; set; } = UnitCell.Cubic;
    }

    /// <summary>A functional structure, beside its function and grid.</summary>
    public sealed class FunctionalOptions
    {
        public FunctionalKind Kind { get; set; } = FunctionalKind.Network;
        /// <summary>Value of the function at the surface.</summary>
        public Param? Level { get; set; }
        /// <summary>Sheets: mean thickness of the wall, instead of the level.</summary>
        public Param? Thickness { get; set; }
        /// <summary>Cells of varying size.</summary>
        public Period Period { get; set; }
        /// <summary>Cells around an axis or a point.</summary>
        public Warp Warp { get; set; }
    }

    /// <summary>A fine structure.</summary>
    public sealed unsafe class Structure : Handle
    {
        private Structure(msq_structure* made) : base(made) { }

        internal msq_structure* In(Call call) => (msq_structure*)call.Use(this, "structure");

        /// <summary>Struts of one of the unit cells of msq.</summary>
        public static Structure Lattice(Context context, UnitCell unitCell, Grid grid, Param radius,
                                        LatticeOptions options = null)
        {
            msq_lattice_def def = msq_lattice_def.Defaults();
            def.unit_cell = (int)unitCell;
            return Lattice(context, def, grid, radius, null, null, options);
        }

        /// <summary>Struts of a unit cell of the program's own. nodes: in the unit cube. struts: pairs of
        /// indices of nodes.</summary>
        public static Structure Lattice(Context context, Vec3[] nodes, int[] struts, Grid grid, Param radius,
                                        LatticeOptions options = null)
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
            return Lattice(context, def, grid, radius, nodes, struts, options);
        }

        private static Structure Lattice(Context context, msq_lattice_def def, Grid grid, Param radius, Vec3[] nodes,
                                         int[] struts, LatticeOptions options)
        {
            Grid.Set(&def.grid, grid);
            using (var call = new Call())
            {
                def.nodes = (double*)call.Pin(nodes);
                def.struts = (uint*)call.Pin(struts);
                def.radius = radius.In(call);
                def.period = Period.In(call, options?.Period);
                def.warp = Warp.In(call, options?.Warp);
                return From(context, &def);
            }
        }

        /// <summary>Plates of one of the unit cells of msq. thickness: whole thickness of the plates.</summary>
        public static Structure PlateLattice(Context context, PlateCell plateCell, Grid grid, Param thickness,
                                             PlateLatticeOptions options = null)
        {
            msq_plate_lattice_def def = msq_plate_lattice_def.Defaults();
            def.plate_cell = (int)plateCell;
            return PlateLattice(context, def, grid, thickness, null, null, options);
        }

        /// <summary>Plates of a unit cell of the program's own. nodes: in the unit cube. faces: triples of
        /// indices of nodes.</summary>
        public static Structure PlateLattice(Context context, Vec3[] nodes, int[] faces, Grid grid, Param thickness,
                                             PlateLatticeOptions options = null)
        {
            if (nodes == null) throw new ArgumentNullException(nameof(nodes));
            if (faces == null) throw new ArgumentNullException(nameof(faces));
            if (faces.Length % 3 != 0)
                throw new ArgumentException("faces has " + faces.Length + " indices; it must have three for each",
                                            nameof(faces));
            msq_plate_lattice_def def = msq_plate_lattice_def.Defaults();
            def.plate_cell = (int)PlateCell.Custom;
            def.node_count = (ulong)nodes.Length;
            def.face_count = (ulong)(faces.Length / 3);
            return PlateLattice(context, def, grid, thickness, nodes, faces, options);
        }

        private static Structure PlateLattice(Context context, msq_plate_lattice_def def, Grid grid, Param thickness,
                                              Vec3[] nodes, int[] faces, PlateLatticeOptions options)
        {
            options = options ?? new PlateLatticeOptions();
            Grid.Set(&def.grid, grid);
            def.unit_cell = (int)options.UnitCell;
            if (options.FaceFactors != null)
            {
                if (nodes != null && (ulong)options.FaceFactors.Length != def.face_count)
                    throw new ArgumentException("FaceFactors has " + options.FaceFactors.Length +
                                                " numbers; it must have " + def.face_count, nameof(options));
                def.face_count = (ulong)options.FaceFactors.Length;
            }
            using (var call = new Call())
            {
                def.nodes = (double*)call.Pin(nodes);
                def.faces = (uint*)call.Pin(faces);
                def.face_factors = (double*)call.Pin(options.FaceFactors);
                def.thickness = thickness.In(call);
                if (options.Radius.HasValue) def.radius = options.Radius.Value.In(call);
                return From(context, &def);
            }
        }

        /// <summary>The struts of a Voronoi foam, its walls, or both.</summary>
        public static Structure Foam(Context context, Grid grid, Param radius, FoamOptions options = null)
        {
            options = options ?? new FoamOptions();
            if (options.Stretch != null && options.Stretch.Length != 3)
                throw new ArgumentException("Stretch has " + options.Stretch.Length + " numbers; it must have 3",
                                            nameof(options));
            msq_foam_def def = msq_foam_def.Defaults();
            Grid.Set(&def.grid, grid);
            def.method = (int)options.Method;
            def.seed = unchecked((ulong)options.Seed); // all 64 bits
            def.weight = options.Weight;
            if (options.Jitter.HasValue) def.jitter = options.Jitter.Value;
            using (var call = new Call())
            {
                def.radius = radius.In(call);
                if (options.Density.HasValue) def.density = options.Density.Value.In(call);
                if (options.WallThickness.HasValue) def.wall_thickness = options.WallThickness.Value.In(call);
                if (options.VentRadius.HasValue) def.vent_radius = options.VentRadius.Value.In(call);
                if (options.Stretch != null)
                    for (int axis = 0; axis < 3; ++axis) def.stretch[axis] = options.Stretch[axis];
                def.period = Period.In(call, options.Period);
                def.warp = Warp.In(call, options.Warp);
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
                def.period = Period.In(call, options.Period);
                def.warp = Warp.In(call, options.Warp);
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
            if (options.Period != null || options.Warp != null)
                throw new ArgumentException("functions of the program have no period and no warp", nameof(options));
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

        public static Structure Union(params Structure[] structures) => Combine(BooleanOperation.Union, structures);
        public static Structure Intersection(params Structure[] structures) =>
            Combine(BooleanOperation.Intersection, structures);
        /// <summary>The first without the others.</summary>
        public static Structure Difference(params Structure[] structures) =>
            Combine(BooleanOperation.Difference, structures);

        private static Structure Combine(BooleanOperation operation, Structure[] structures)
        {
            if (structures == null) throw new ArgumentNullException(nameof(structures));
            var pointers = new IntPtr[structures.Length];
            msq_structure* made;
            using (var call = new Call())
            {
                for (int i = 0; i < structures.Length; ++i)
                    pointers[i] = (IntPtr)call.Use(structures[i], nameof(structures));
                call.Check(Abi.msq_structure_boolean((int)operation, (msq_structure**)call.Pin(pointers),
                                                     (ulong)pointers.Length, &made));
            }
            return new Structure(made);
        }

        /// <summary>The union, with fillets of a radius where a and b meet.</summary>
        public static Structure SmoothUnion(Structure a, Structure b, Param radius) =>
            Smooth(BooleanOperation.Union, a, b, radius);
        /// <summary>The intersection, with rounds of a radius where the surfaces of a and b meet.</summary>
        public static Structure SmoothIntersection(Structure a, Structure b, Param radius) =>
            Smooth(BooleanOperation.Intersection, a, b, radius);
        /// <summary>a without b, with rounds of a radius where their surfaces meet.</summary>
        public static Structure SmoothDifference(Structure a, Structure b, Param radius) =>
            Smooth(BooleanOperation.Difference, a, b, radius);

        private static Structure Smooth(BooleanOperation operation, Structure a, Structure b, Param radius)
        {
            msq_structure* made;
            using (var call = new Call())
            {
                msq_param given = radius.In(call);
                call.Check(Abi.msq_structure_smooth_boolean((int)operation, (msq_structure*)call.Use(a, nameof(a)),
                                                            (msq_structure*)call.Use(b, nameof(b)), &given, &made));
            }
            return new Structure(made);
        }

        /// <summary>Becomes b as the fraction goes from 0 to 1.</summary>
        public static Structure Blend(Structure a, Structure b, Param fraction)
        {
            msq_structure* made;
            using (var call = new Call())
            {
                msq_param given = fraction.In(call);
                call.Check(Abi.msq_structure_blend((msq_structure*)call.Use(a, nameof(a)),
                                                   (msq_structure*)call.Use(b, nameof(b)), &given, &made));
            }
            return new Structure(made);
        }

        /// <summary>By a definition of msq.h. Its pointers must be valid until this returns.</summary>
        public static Structure From(Context context, msq_plate_lattice_def* def)
        {
            msq_structure* made;
            using (var call = new Call()) call.Check(Abi.msq_structure_plate_lattice(call.Use(context), def, &made));
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
