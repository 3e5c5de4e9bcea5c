// SPDX-License-Identifier: Apache-2.0
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Threading;
using Msq.Interop;

namespace Msq.Tests
{
    static class Tests
    {
        private static readonly Context context = new Context();
        private static readonly Context pool = new Context(new ContextOptions { UseThreadPool = true, Threads = 4 });
        private static readonly Vec3 zero = new Vec3(0, 0, 0);
        private static readonly Vec3 ten = new Vec3(10, 10, 10);

        internal static int Run()
        {
            int failed = 0, count = 0;
            foreach (MethodInfo test in typeof(Tests).GetMethods(BindingFlags.Static | BindingFlags.NonPublic))
            {
                if (!test.Name.StartsWith("Test", StringComparison.Ordinal)) continue;
                ++count;
                try
                {
                    test.Invoke(null, null);
                }
                catch (TargetInvocationException error)
                {
                    ++failed;
                    Console.WriteLine("{0} failed: {1}", test.Name, error.InnerException);
                }
            }
            Console.WriteLine("{0} tests, {1} failed", count, failed);
            return failed == 0 && count > 20 ? 0 : 1;
        }

        private static void Equal<T>(T wanted, T found, [CallerLineNumber] int line = 0)
        {
            if (!EqualityComparer<T>.Default.Equals(wanted, found))
                throw new Exception("line " + line + ": " + found + "; it must be " + wanted);
        }

        private static void True(bool condition, [CallerLineNumber] int line = 0) => Equal(true, condition, line);

        private static T Throws<T>(Action action, [CallerLineNumber] int line = 0) where T : Exception
        {
            try
            {
                action();
            }
            catch (T error)
            {
                return error;
            }
            throw new Exception("line " + line + ": no " + typeof(T).Name);
        }

        private static Model Lattice()
        {
            Shape box = Shape.Box(context, zero, ten);
            return new Model(context, box, Structure.Lattice(context, UnitCell.Bcc, 5, 0.8));
        }

        private static Slicer SlicerOf(Model model, LayerOutput output = LayerOutput.Bits) =>
            new Slicer(model, new SlicerOptions(0.5, 0.5) { Output = output });

        private static Vec3[] Points(int count)
        {
            var random = new Random(7);
            Func<double> draw = () => 12 * random.NextDouble() - 1;
            return Enumerable.Range(0, count).Select(_ => new Vec3(draw(), draw(), draw())).ToArray();
        }

        static void TestVersion()
        {
            Equal((int)Abi.MSQ_VERSION, Library.Version);
            True(Library.Licence.Length > 0 && Library.Simd.Length > 0);
        }

        static void TestStatusAndMessage()
        {
            var error = Throws<MsqException>(() => Shape.Sphere(context, zero, -1));
            Equal(StatusCode.Argument, error.Status);
            True(error.Message.StartsWith("MSQ_E_ARGUMENT: radius is -1", StringComparison.Ordinal));
            Equal(0, error.HostCode);
            Equal(StatusCode.Io, Throws<MsqException>(() => Shape.FromFile(context, "no such file.stl")).Status);
        }

        static void TestNullIsRefused()
        {
            Equal("context", Throws<ArgumentNullException>(() => Shape.Sphere(null, zero, 1)).ParamName);
            Equal("shape", Throws<ArgumentNullException>(() => new Model(context, null)).ParamName);
            Equal("shapes", Throws<ArgumentNullException>(() => Shape.Union(null, null)).ParamName);
            Throws<ArgumentNullException>(() => Lattice().Membership((Vec3[])null));
            Throws<ArgumentException>(() => Shape.FromFile(context, "a\0b"));
        }

        static void TestDisposedObjectIsRefused()
        {
            Shape box = Shape.Box(context, zero, ten);
            var model = new Model(context, box);
            box.Dispose();
            box.Dispose();
            Throws<ObjectDisposedException>(() => new Model(context, box));
            True(model.Contains(new Vec3(5, 5, 5))); // the model keeps its shape
        }

        static void TestMembershipOfArrays()
        {
            Model model = Lattice();
            Vec3[] points = Points(500);
            bool[] found = model.Membership(points);
            True(found.Contains(true) && found.Contains(false));
            for (int i = 0; i < points.Length; ++i) Equal(model.Contains(points[i]), found[i]);
            double[] triples = points.SelectMany(one => new[] { one.X, one.Y, one.Z }).ToArray();
            True(found.SequenceEqual(model.Membership(triples)));
            double[] distances = model.Distance(points);
            for (int i = 0; i < points.Length; ++i) Equal(found[i], distances[i] <= 0);
            True(distances.SequenceEqual(model.Distance(triples)));
            Equal(0, model.Membership(new Vec3[0]).Length);
            Throws<ArgumentException>(() => model.Membership(new double[4]));
        }

#if MSQ_SPAN
        static void TestSpans()
        {
            Model model = Lattice();
            Vec3[] points = Points(100);
            double[] triples = points.SelectMany(one => new[] { one.X, one.Y, one.Z }).ToArray();
            var inside = new bool[102];
            model.Membership(triples, new Span<bool>(inside, 1, 100));
            True(inside.Skip(1).Take(100).SequenceEqual(model.Membership(points)));
            True(!inside[0] && !inside[101]);
            var distances = new double[100];
            model.Distance(triples, distances);
            True(distances.SequenceEqual(model.Distance(points)));
            Throws<ArgumentException>(() => model.Membership(triples, inside));
            var slicer = SlicerOf(model);
            slicer.Run(0, 1, layer => True(layer.Data.SequenceEqual(slicer.Layer(0).Data)));
        }
#endif

        static void TestGrid()
        {
            Model model = Lattice();
            bool[] found = model.GridMembership(new Vec3(0.25, 0.5, 0.75), new Vec3(0.5, 1, 2), 20, 10, 5);
            Equal(1000, found.Length);
            for (int i = 0; i < found.Length; ++i)
            {
                var point = new Vec3(0.25 + i % 20 * 0.5, 0.5 + i / 20 % 10, 0.75 + i / 200 * 2);
                Equal(model.Contains(point), found[i]);
            }
            Throws<ArgumentException>(() => model.GridMembership(zero, ten, 0, 1, 1));
        }

        static void TestHashes()
        {
            if (!Library.HasHashes) return;
            Equal(Lattice().Hash, Lattice().Hash);
            Equal(32, Lattice().Hash.Length);
            Shape one = Shape.Sphere(context, zero, 1), two = Shape.Sphere(context, zero, 2);
            True(one.Hash != two.Hash);
            True(Structure.Foam(context, 2, 0.2).Hash !=
                 Structure.Foam(context, 2, 0.2, new FoamOptions { Seed = 1 }).Hash);
            True(Structure.Foam(context, 2, 0.2).Hash !=
                 Structure.Foam(context, 2, 0.2, new FoamOptions { Jitter = 0.5 }).Hash);
        }

        static void TestShapes()
        {
            Shape box = Shape.Box(context, zero, ten);
            Equal(zero, box.Min);
            Equal(ten, box.Max);
            Shape drill = Shape.Cylinder(context, new Vec3(5, 5, -1), new Vec3(5, 5, 11), 2);
            var model = new Model(context, Shape.Difference(box, drill));
            True(!model.Contains(new Vec3(5, 5, 5)) && model.Contains(new Vec3(1, 1, 5)));
            True(new Model(context, Shape.Intersection(box, drill)).Contains(new Vec3(5, 5, 5)));
            True(new Model(context, Shape.Union(box, Shape.Sphere(context, ten, 1))).Contains(new Vec3(10.5, 10, 10)));
            Shape moved = box.Placed(new double[] { 1, 0, 0, 100, 0, 1, 0, 0, 0, 0, 1, 0 });
            True(Math.Abs(moved.Min.X - 100) < 1e-9);
            True(new Model(context, box.Offset(1)).Contains(new Vec3(-0.5, 5, 5)));
            Throws<ArgumentException>(() => box.Placed(new double[9]));
            True(new Model(context, Shape.AllSpace(context), Structure.Lattice(context, UnitCell.Cubic, 5, 1))
                     .Contains(new Vec3(1000, 0, 0)));
        }

        private static readonly int[] tetrahedron = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2 };

        static void TestMeshes()
        {
            var vertices = new[] { zero, new Vec3(6, 0, 0), new Vec3(0, 6, 0), new Vec3(0, 0, 6) };
            Shape shape = Shape.FromMesh(context, vertices, tetrahedron);
            Equal(4L, shape.TriangleCount);
            Equal(0L, shape.OpenEdgeCount);
            float[] floats = vertices.SelectMany(one => new[] { (float)one.X, (float)one.Y, (float)one.Z }).ToArray();
            double[] doubles = Array.ConvertAll(floats, one => (double)one);
            foreach (Shape one in new[] { shape, Shape.FromMesh(context, floats, tetrahedron),
                                          Shape.FromMesh(context, doubles, tetrahedron) })
            {
                var model = new Model(context, one);
                True(model.Contains(new Vec3(1, 1, 1)) && !model.Contains(new Vec3(3, 3, 3)));
            }
            Throws<MsqException>(() => Shape.FromMesh(context, vertices, new[] { 0, 1, -1 }));
            Throws<ArgumentException>(() => Shape.FromMesh(context, vertices, new[] { 0, 1 }));
        }

        static void TestFilesInMemory()
        {
            string text = "v 0 0 0\nv 6 0 0\nv 0 6 0\nv 0 0 6\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
            byte[] data = System.Text.Encoding.ASCII.GetBytes(text);
            Shape shape = Shape.FromMemory(context, data, new FileOptions { Format = Format.Obj, UnitMm = 2 });
            Equal(4L, shape.TriangleCount);
            Equal(12.0, shape.Max.X);
        }

        static void TestFields()
        {
            Shape box = Shape.Box(context, zero, ten);
            Func<Param, bool> isThick = radius =>
                new Model(context, box, Structure.Lattice(context, UnitCell.Cubic, 5, radius)).Contains(new Vec3(5, 2.5, 5.6));
            True(isThick(0.7) && !isThick(0.5));
            True(isThick(Field.Gradient(context, zero, 0.1, ten, 1.9)));
            True(!isThick(Field.Gradient(context, zero, 0.1, ten, 0.9)));
            True(isThick(Field.Radial(context, zero, 0, 0.1, 16, 1.5)));
            Field formula = Field.Expression(context, "a * y", 0, 5, new Dictionary<string, double> { { "a", 0.28 } });
            True(isThick(formula));
            True(!isThick(formula.Map(context, new Vec2(0, 0.1), new Vec2(1, 0.2))));
            True(isThick(Field.ShapeDistance(context, box, new[] { new Vec2(-5, 1.5), new Vec2(0, 0.1) }, 0.5)));
            Equal(StatusCode.Argument,
                  Throws<MsqException>(() => Field.Expression(context, "a * y", 0, 5)).Status);
        }

        static void TestStructures()
        {
            Shape box = Shape.Box(context, zero, ten);
            Func<Structure, int> count = structure => new Model(context, box, structure)
                .GridMembership(new Vec3(0.1, 0.1, 0.1), new Vec3(0.5, 0.5, 0.5), 20, 20, 20).Count(one => one);
            var cross = new[] { new Vec3(0, 0.5, 0.5), new Vec3(1, 0.5, 0.5) };
            int own = count(Structure.Lattice(context, cross, new[] { 0, 1 }, 5, 1));
            True(own > 700 && own < 1400); // 4 rods of radius 1: 12.6 % of 8000
            int thin = count(Structure.Foam(context, 3, 0.2)), walls = count(
                Structure.Foam(context, 3, 0.2, new FoamOptions { WallThickness = 0.4 }));
            True(thin > 0 && walls > 2 * thin);
            True(count(Structure.Foam(context, 3, 0.2, new FoamOptions { Density = 4 })) > thin);
            int network = count(Structure.Functional(context, Function.Gyroid, 5));
            True(network > 3500 && network < 4500);
            var sheet = new FunctionalOptions { Kind = FunctionalKind.Sheet, Thickness = 0.5 };
            True(count(Structure.Functional(context, Function.Gyroid, 5, sheet)) < network);
            int formula = count(Structure.Expression(
                context, "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x) - c", 5,
                parameters: new Dictionary<string, double> { { "c", 0 } }));
            True(Math.Abs(formula - network) < 40);
            Throws<ArgumentException>(() => Structure.Foam(context, new Grid(ten, zero, new double[3]), 0.2));
        }

        static void TestWarpedCells()
        {
            Shape ball = Shape.Sphere(context, zero, 8);
            Func<Structure, Vec3[], bool[]> inside = (one, at) => new Model(context, ball, one).Membership(at);
            Vec3[] points = Array.ConvertAll(Points(1000), one => new Vec3(one.X - 5, one.Y - 5, one.Z - 5));
            double sin = Math.Sin(2 * Math.PI / 9), cos = Math.Cos(2 * Math.PI / 9);
            Vec3[] turned = Array.ConvertAll( // by one cell
                points, one => new Vec3(cos * one.X - sin * one.Y, sin * one.X + cos * one.Y, one.Z));
            foreach (Warp warp in new[] { new Warp(9, 1, 4, shearAlong: 0.5), new Warp(9, 1, 4, countPolar: 5) })
            {
                Structure gyroid = Structure.Functional(context, Function.Gyroid, 1.5, new FunctionalOptions { Warp = warp });
                Structure bcc = Structure.Lattice(context, UnitCell.Bcc, 1.5, 0.2, new LatticeOptions { Warp = warp });
                foreach (Structure one in new[] { gyroid, bcc })
                {
                    bool[] here = inside(one, points), there = inside(one, turned);
                    True(here.Contains(true) && here.Contains(false));
                    True(here.Zip(there, (a, b) => a != b).Count(differs => differs) < 4);
                }
            }
            var none = new LatticeOptions { Warp = new Warp(0) };
            True(Throws<MsqException>(() => Structure.Lattice(context, UnitCell.Bcc, 5, 0.2, none))
                     .Message.Contains("warp.count is 0"));
        }

        static void TestCellsBySamples()
        {
            Shape box = Shape.Box(context, zero, ten);
            Func<Warp, bool[]> inside = warp => new Model(
                context, box, Structure.Lattice(context, UnitCell.Bcc, 2.5, 0.4, new LatticeOptions { Warp = warp }))
                .GridMembership(new Vec3(0.1, 0.1, 0.1), new Vec3(0.49, 0.49, 0.49), 20, 20, 20);
            Func<int, double, Field> coordinate = (axis, size) =>
            {
                var values = new double[216];
                for (int i = 0; i < 216; ++i)
                    values[i] = (4 * new[] { i % 6, i / 6 % 6, i / 36 }[axis] - 5) / size;
                return Field.Grid(context, values, 6, 6, 6, new Vec3(-5, -5, -5), new Vec3(4, 4, 4));
            };
            Func<Field, Warp> map = third => Warp.Sampled(coordinate(0, 2.5), coordinate(1, 2.5), third);
            bool[] plain = inside(null);
            Func<Warp, int> differing = warp => inside(warp).Zip(plain, (a, b) => a != b).Count(differs => differs);
            True(differing(map(coordinate(2, 2.5))) < 8);
            True(differing(map(coordinate(2, 4))) > 100);
            True(Throws<MsqException>(() => inside(map(coordinate(1, 2.5)))).Message.Contains("folds"));
            Throws<ArgumentException>(() => Field.Grid(context, new double[7], 2, 2, 2, zero, ten));
            Throws<ArgumentNullException>(() => Warp.Sampled(null, null, null));
        }

        static void TestPeriodsAndStretches()
        {
            Shape box = Shape.Box(context, zero, ten);
            Func<Structure, bool[]> inside = one => new Model(context, box, one)
                .GridMembership(new Vec3(0.1, 0.1, 0.1), new Vec3(0.49, 0.49, 0.49), 20, 20, 20);
            Func<bool[], bool[], int> differ = (a, b) => a.Zip(b, (one, other) => one != other).Count(one => one);
            var grid = new Grid(new Vec3(7, 2.5, 2.5)); // the period has its own size along x
            Func<double[], Period> period = sizes =>
                new Period(sizes.Select((_, i) => 5.0 * i).ToArray(), sizes, axis: 0);
            Func<double[], Structure> bcc = sizes =>
                Structure.Lattice(context, UnitCell.Bcc, grid, 0.4, new LatticeOptions { Period = period(sizes) });
            Func<double[], Structure> sheet = sizes =>
                Structure.Functional(context, Function.Gyroid, grid, new FunctionalOptions
                { Kind = FunctionalKind.Sheet, Thickness = 0.4, Period = period(sizes) });
            var one25 = new[] { 2.5 };
            var graded = new[] { 2.5, 1.5 };
            True(differ(inside(bcc(one25)), inside(Structure.Lattice(context, UnitCell.Bcc, 2.5, 0.4))) < 8);
            True(differ(inside(bcc(one25)), inside(bcc(graded))) > 100);
            True(differ(inside(sheet(one25)), inside(sheet(graded))) > 100);
            Throws<ArgumentException>(() => new Period(graded, one25));
            Throws<MsqException>(() => bcc(new double[0]));
            Func<double[], bool[]> foam = stretch =>
                inside(Structure.Foam(context, 2, 0.3, new FoamOptions { Stretch = stretch }));
            True(foam(new double[] { 2, 2, 2 }).SequenceEqual(foam(null))); // only the proportions count
            True(differ(foam(new double[] { 1, 1, 3 }), foam(null)) > 100);
            Throws<ArgumentException>(() => foam(new double[2]));
            Func<double, bool[]> weighted = weight =>
                inside(Structure.Foam(context, 2, 0.3, new FoamOptions { Weight = weight }));
            True(weighted(0).SequenceEqual(foam(null)));
            True(differ(weighted(2), foam(null)) > 100);
            Func<double[], bool[]> spaced = sizes =>
                inside(Structure.Foam(context, grid, 0.3, new FoamOptions { Period = period(sizes) }));
            True(differ(spaced(one25), inside(Structure.Foam(context, 2.5, 0.3))) < 8);
            True(differ(spaced(one25), spaced(graded)) > 100);
            Throws<MsqException>(() => weighted(2.5));
            Func<double, bool[]> around = outer =>
                inside(Structure.Foam(context, 2.5, 0.3, new FoamOptions { Warp = new Warp(12, 3, outer) }));
            True(differ(around(6), foam(null)) > 100);
            Throws<MsqException>(() => around(0));
        }

        static void TestPlates()
        {
            Shape box = Shape.Box(context, zero, ten);
            Func<Structure, int> count = one => new Model(context, box, one)
                .GridMembership(new Vec3(0.1, 0.1, 0.1), new Vec3(0.2, 0.2, 0.2), 50, 50, 50).Count(isIn => isIn);
            Equal(125000 - 40 * 40 * 40, count(Structure.PlateLattice(context, PlateCell.Cubic, 2, 0.4)));
            var corners = new[] { zero, new Vec3(1, 0, 0), new Vec3(1, 1, 0), new Vec3(0, 1, 0) };
            var floor = new[] { 0, 1, 2, 0, 2, 3 };
            Equal(125000 / 5, count(Structure.PlateLattice(context, corners, floor, 2, 0.4)));
            var thin = new PlateLatticeOptions { FaceFactors = new[] { 0.01, 0.01 } };
            Equal(0, count(Structure.PlateLattice(context, corners, floor, 2, 0.4, thin)));
            thin.Radius = 0.3;
            True(count(Structure.PlateLattice(context, corners, floor, 2, 0.4, thin)) > 5000);
            thin.FaceFactors = new[] { 1.0 };
            Throws<ArgumentException>(() => Structure.PlateLattice(context, corners, floor, 2, 0.4, thin));
            Throws<ArgumentException>(() => Structure.PlateLattice(context, corners, new int[4], 2, 0.4));
        }

        static void TestStructuresOfStructures()
        {
            Shape box = Shape.Box(context, zero, ten);
            Func<Structure, bool[]> inside = one => new Model(context, box, one)
                .GridMembership(new Vec3(0.1, 0.1, 0.1), new Vec3(0.31, 0.31, 0.31), 32, 32, 32);
            Structure bcc = Structure.Lattice(context, UnitCell.Bcc, 2.5, 0.3);
            Structure gyroid = Structure.Functional(context, Function.Gyroid, 2.5);
            bool[] a = inside(bcc), b = inside(gyroid);
            Action<Func<bool, bool, bool>, Structure, Structure, bool> check = (both, plain, smooth, grows) =>
            {
                bool[] wanted = a.Zip(b, both).ToArray(), found = inside(smooth);
                True(wanted.SequenceEqual(inside(plain)));
                bool[] changed = wanted.Zip(found, (one, other) => one != other).ToArray();
                True(changed.Contains(true));
                for (int i = 0; i < changed.Length; ++i) True(!changed[i] || found[i] == grows);
            };
            check((x, y) => x || y, Structure.Union(bcc, gyroid), Structure.SmoothUnion(bcc, gyroid, 0.4), true);
            check((x, y) => x && y, Structure.Intersection(bcc, gyroid), Structure.SmoothIntersection(bcc, gyroid, 0.4),
                  false);
            check((x, y) => x && !y, Structure.Difference(bcc, gyroid), Structure.SmoothDifference(bcc, gyroid, 0.4),
                  false);
            True(a.SequenceEqual(inside(Structure.Blend(bcc, gyroid, 0))));
            True(b.SequenceEqual(inside(Structure.Blend(bcc, gyroid, 1))));
            Throws<MsqException>(() => Structure.SmoothUnion(bcc, gyroid, -1));
            Throws<ArgumentNullException>(() => Structure.SmoothUnion(null, gyroid, 1));
        }

        static void TestRotatedGridsAndSkins()
        {
            Shape box = Shape.Box(context, zero, ten);
            var turned = new Grid(new Vec3(5, 5, 5), new Vec3(1, 0, 0), new double[] { 0, -1, 0, 1, 0, 0, 0, 0, 1 });
            Structure rods = Structure.Lattice(context, new[] { new Vec3(0, 0.5, 0.5), new Vec3(1, 0.5, 0.5) },
                                               new[] { 0, 1 }, turned, 0.5);
            var model = new Model(context, box, rods); // the rods lie along y now
            bool alongY = model.Contains(new Vec3(3.5, 3, 2.5)) && model.Contains(new Vec3(3.5, 7, 2.5));
            True(alongY && !model.Contains(new Vec3(1, 2.5, 2.5)));
            var skinned = new Model(context, box, new Scale(rods, 0.5));
            True(skinned.Contains(new Vec3(0.2, 5, 5)) && !model.Contains(new Vec3(0.2, 5, 5)));
        }

        static void TestRegions()
        {
            var left = new Model(context, Shape.Box(context, zero, new Vec3(5, 10, 10)));
            var right = new Model(context, Shape.Box(context, zero, ten), Structure.Lattice(context, UnitCell.Bcc, 5, 0.2));
            Model both = Model.Regions(context, left, right);
            True(both.Contains(new Vec3(3, 1, 2)) && !both.Contains(new Vec3(8, 1, 2)));
            Vec3 min, max;
            both.Bounds(out min, out max);
            Equal(zero, min);
            Equal(ten, max);
        }

        static void TestDefinitions()
        {
            unsafe
            {
                msq_lattice_def def = msq_lattice_def.Defaults();
                def.unit_cell = Abi.MSQ_UNIT_CELL_BCC;
                for (int i = 0; i < 3; ++i) def.grid.cell_size[i] = 5;
                def.radius.value = 0.8;
                var model = new Model(context, Shape.Box(context, zero, ten), Structure.From(context, &def));
                Vec3[] points = Points(100);
                True(model.Membership(points).SequenceEqual(Lattice().Membership(points)));
            }
        }

        static void TestRays()
        {
            var model = new Model(context, Shape.Sphere(context, zero, 2));
            var origins = new[] { new Vec3(10, 0, 0), new Vec3(10, 5, 0), zero };
            var along = new Vec3(-1, 0, 0);
            RayHit[] hits = model.CastRays(origins, new[] { along, along, along });
            True(hits[0].IsHit && Math.Abs(hits[0].T - 8) < 1e-9 && Math.Abs(hits[0].Normal.X - 1) < 1e-9);
            Equal(0, hits[0].Scale);
            True(!hits[1].IsHit && hits[1].Scale == -1 && !hits[1].StartsInside);
            True(hits[2].StartsInside && hits[2].T == 0);
            True(!model.CastRays(origins, new[] { along, along, along }, 7)[0].IsHit);
            Throws<ArgumentException>(() => model.CastRays(origins, new Vec3[2]));
            unsafe { Equal(sizeof(msq_ray_hit), sizeof(RayHit)); }
        }

        static void TestContours()
        {
            Shape ring = Shape.Difference(Shape.Cylinder(context, zero, new Vec3(0, 0, 4), 4),
                                          Shape.Cylinder(context, new Vec3(0, 0, -1), new Vec3(0, 0, 5), 2));
            var model = new Model(context, ring);
            Contours contours = model.Contours(2, new ContoursOptions(0.01) { Pitch = 0.2 });
            Equal(2, contours.Count);
            IList<Ring> rings = contours.Rings();
            True(!rings[0].IsHole && rings[1].IsHole);
            Equal(-1, rings[0].Parent);
            Equal(0, rings[1].Parent);
            foreach (Vec2 point in rings[1].Points) True(Math.Abs(Math.Sqrt(point.X * point.X + point.Y * point.Y) - 2) < 0.02);
            Equal(2, SlicerOf(model).Contours(3, new ContoursOptions(0.01) { Pitch = 0.2 }).Count);
            Equal(0, model.Contours(9, new ContoursOptions(0.01) { Pitch = 0.2 }).Rings().Count);
            Throws<MsqException>(() => model.Contours(2, new ContoursOptions(-1)));
        }

        static void TestPreviewMesh()
        {
            var model = new Model(context, Shape.Sphere(context, zero, 2));
            Mesh mesh = model.Mesh(0.2);
            True(mesh.Triangles.Length > 1000 && mesh.Normals.Length == 3 * mesh.Vertices.Length);
            foreach (Vec3 one in mesh.Vertices) True(Math.Abs(one.X * one.X + one.Y * one.Y + one.Z * one.Z - 4) < 1e-2);
            Shape again = Shape.FromMesh(context, mesh.Vertices, mesh.Triangles);
            Equal(0L, again.OpenEdgeCount);
            True(model.Mesh(0.2, zero, ten).Triangles.Length < mesh.Triangles.Length);
        }

        static void TestLayers()
        {
            Slicer slicer = SlicerOf(Lattice());
            Equal(20, slicer.Width);
            Equal(20L, slicer.LayerCount);
            Equal(0.25, slicer.Origin.X);
            var seen = new List<Layer>();
            LayerView kept = null;
            slicer.Run(layer =>
            {
                Equal((long)seen.Count, layer.Index);
                seen.Add(layer.Copy());
                kept = layer;
            });
            Throws<ObjectDisposedException>(() => kept.Copy());
            List<Layer> pulled = slicer.Layers().ToList();
            Equal(20, pulled.Count);
            Model model = Lattice();
            for (int i = 0; i < 20; ++i)
            {
                True(seen[i].Data.SequenceEqual(pulled[i].Data));
                Equal(seen[i].Z, pulled[i].Z);
                for (int x = 0; x < 20; ++x)
                    Equal(model.Contains(new Vec3(0.25 + 0.5 * x, 3.25, seen[i].Z)), seen[i].IsInside(x, 6));
            }
            Layer bytes = SlicerOf(model, LayerOutput.Bytes).Layer(3);
            for (int x = 0; x < 20; ++x) Equal(seen[3].IsInside(x, 6), bytes.IsInside(x, 6));
            Equal(StatusCode.Argument, Throws<MsqException>(() => slicer.Layer(20)).Status);
            Throws<ArgumentOutOfRangeException>(() => bytes.IsInside(20, 0));
        }

        private static void Refuses(string name, Action action, [CallerLineNumber] int line = 0)
        {
            var error = Throws<ArgumentOutOfRangeException>(action, line);
            Equal(name, error.ParamName, line);
            True(error.Message.Contains(name + " is -1; it must be at least 0"), line);
        }

        static void TestNegativeNumbersAreRefused()
        {
            Model model = Lattice();
            Slicer slicer = SlicerOf(model);
            int calls = 0;
            Refuses("count", () => slicer.Run(0, -1, layer => ++calls));
            Refuses("first", () => slicer.Run(-1, 1, layer => ++calls));
            Equal(0, calls);
            Refuses("index", () => slicer.Layer(-1));
            Refuses("index", () => slicer.Z(-1));
            Refuses("index", () => slicer.Contours(-1, new ContoursOptions(0.1)));
            Refuses("GreySamples", () => new Slicer(model, new SlicerOptions(0.5, 0.5) { GreySamples = -1 }));
            Refuses("Threads", () => new Context(new ContextOptions { Threads = -1 }));
            Refuses("CacheBytes", () => new Context(new ContextOptions { CacheBytes = -1 }));
            Refuses("MemoryLimit", () => new Context(new ContextOptions { MemoryLimit = -1 }));
        }

        static void TestLayersOfContours()
        {
            if (!Library.HasDocuments) return;
            string text = "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"box\": {\"min\": [0, 0, 0], \"max\": " +
                "[4, 4, 4]}}}], \"slicing\": {\"pitch\": 0.5, \"layer_height\": 0.5, \"outputs\": " +
                "[{\"output\": \"contours\", \"contours\": {\"tolerance\": 0.1}}]}}";
            int calls = 0;
            Document.FromJson(context, text).Slicer().Run(layer =>
            {
                ++calls;
                Equal(IntPtr.Zero, layer.Pointer);
                Equal(0, layer.Copy().Data.Length);
            });
            Equal(8, calls);
        }

        static void TestSlicerOptions()
        {
            Model model = Lattice();
            var heights = new SlicerOptions(0.5, 0) { Heights = new[] { 1.0, 2.5, 7.0 } };
            var slicer = new Slicer(model, heights);
            Equal(3L, slicer.LayerCount);
            Equal(2.5, slicer.Z(1));
            var region = new SlicerOptions(0.5, 0.5) { Region = new[] { zero, new Vec3(5, 10, 2) } };
            slicer = new Slicer(model, region);
            Equal(10, slicer.Width);
            Equal(4L, slicer.LayerCount);
            var turned = new SlicerOptions(0.5, 0.5) { Orientation = LayerOrientation.MirrorX };
            Layer plain = SlicerOf(model).Layer(2), mirrored = new Slicer(model, turned).Layer(2);
            for (int x = 0; x < 20; ++x) Equal(plain.IsInside(x, 4), mirrored.IsInside(19 - x, 4));
            Throws<ArgumentException>(() => new Slicer(model, new SlicerOptions(0.5, 0.5) { Region = new Vec3[1] }));
        }

        sealed class OwnException : Exception { }

        static void TestExceptionsOfCallbacks()
        {
            Slicer slicer = SlicerOf(Lattice());
            var thrown = new OwnException();
            int calls = 0;
            var caught = Throws<OwnException>(() => slicer.Run(layer =>
            {
                if (++calls == 3) throw thrown;
            }));
            True(ReferenceEquals(thrown, caught));
            Equal(3, calls);
            True(caught.StackTrace.Contains("TestExceptionsOfCallbacks"));
            slicer.Run(layer => { }); // the next call has forgotten it
        }

        // A thread that waits for its turn finds its exception, however many others throw meanwhile.
        static void TestExceptionsOfManyThreads()
        {
            Slicer slicer = SlicerOf(Lattice());
            int wrong = 0;
            var threads = Enumerable.Range(0, 8).Select(_ => new Thread(() =>
            {
                for (int i = 0; i < 1500; ++i)
                {
                    var thrown = new OwnException();
                    try
                    {
                        slicer.Run(0, 1, layer => throw thrown);
                        Interlocked.Increment(ref wrong);
                    }
                    catch (Exception caught)
                    {
                        if (!ReferenceEquals(thrown, caught)) Interlocked.Increment(ref wrong);
                    }
                }
            })).ToArray();
            foreach (Thread one in threads) one.Start();
            foreach (Thread one in threads) one.Join();
            Equal(0, wrong);
        }

        static void TestNestedExceptions()
        {
            Slicer slicer = SlicerOf(Lattice());
            Throws<OwnException>(() => slicer.Run(outer => slicer.Run(inner => throw new OwnException())));
            int calls = 0;
            slicer.Run(outer =>
            {
                Throws<OwnException>(() => slicer.Run(inner => throw new OwnException()));
                ++calls;
            });
            Equal(20, calls);
            var error = Throws<MsqException>(() => slicer.Run(layer => Shape.Sphere(context, zero, -2)));
            Equal(StatusCode.Argument, error.Status);
        }

        static void TestHostObjects()
        {
            foreach (bool concurrent in new[] { false, true })
            {
                Context context = concurrent ? pool : Tests.context;
                Shape ball = Shape.FromHost(context, new Vec3(-2, -2, -2), new Vec3(2, 2, 2),
                                            p => p.X * p.X + p.Y * p.Y + p.Z * p.Z <= 4, concurrent: concurrent);
                Field thick = Field.FromHost(context, p => 0.3 + 0.01 * p.Z, 0, 1, 0.01, concurrent);
                Structure waves = Structure.FromHost(
                    context, 1, angles => Math.Cos(angles.X), lipschitz: 1, concurrent: concurrent);
                GC.Collect(); // the functions live as long as the objects
                GC.WaitForPendingFinalizers();
                var model = new Model(context, ball, waves);
                Slicer slicer = new Slicer(model, new SlicerOptions(0.1, 0.1));
                long solid = 0;
                slicer.Run(layer => solid += layer.InsideCount);
                True(Math.Abs(solid * 0.001 - 2.0 / 3 * Math.PI * 8) < 1.5); // half of the ball
                True(model.Contains(new Vec3(0.5, 0, 0)) && !model.Contains(new Vec3(1, 0, 0)));
                var graded = new Model(context, ball, Structure.Lattice(context, UnitCell.Cubic, 1, thick));
                True(graded.Contains(new Vec3(0, 0.5, 0.25)) && !graded.Contains(new Vec3(0.5, 0.5, 0.35)));
            }
        }

        static void TestThreadPool()
        {
            Thread caller = Thread.CurrentThread;
            int calls = 0, strange = 0;
            Shape ball = Shape.FromHost(pool, new Vec3(-2, -2, -2), new Vec3(2, 2, 2), p =>
            {
                Interlocked.Increment(ref calls);
                Thread own = Thread.CurrentThread;
                if (own != caller && !own.IsThreadPoolThread) Interlocked.Increment(ref strange);
                return p.X * p.X + p.Y * p.Y + p.Z * p.Z <= 4;
            }, concurrent: true);
            var options = new SlicerOptions(0.1, 0.1);
            long solid = 0, wanted = 0;
            new Slicer(new Model(pool, ball), options).Run(layer => solid += layer.InsideCount);
            new Slicer(new Model(context, Shape.Sphere(context, zero, 2)), options).Run(layer => wanted += layer.InsideCount);
            Equal(wanted, solid);
            True(calls > 10000);
            Equal(0, strange);
            if (Type.GetType("Mono.Runtime") != null)
                Throws<NotSupportedException>(() => Field.FromHost(context, p => 1, 0, 1, concurrent: true));
        }

        static void TestExceptionsOfHostObjects()
        {
            foreach (bool concurrent in new[] { false, true })
            {
                Context context = concurrent ? pool : Tests.context;
                Shape bad = Shape.FromHost(context, zero, ten, p => { throw new OwnException(); }, concurrent: concurrent);
                var model = new Model(context, bad);
                Throws<OwnException>(() => model.Contains(new Vec3(1, 1, 1)));
                Throws<OwnException>(() => model.Membership(Points(5000)));
                Throws<OwnException>(() => SlicerOf(model).Run(layer => { }));
                Field wild = Field.FromHost(context, p => double.NaN, 0, 1, 1, concurrent);
                var graded = new Model(context, Shape.Box(context, zero, ten),
                                       Structure.Lattice(context, UnitCell.Cubic, 5, wild));
                var error = Throws<MsqException>(() => graded.Contains(new Vec3(1, 1, 1)));
                Equal(StatusCode.Host, error.Status);
                Equal(0, error.HostCode);
            }
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static WeakReference ForgottenFunction()
        {
            var marker = new object();
            using (Shape shape = Shape.FromHost(context, zero, ten, p => marker != null)) { }
            Throws<MsqException>(() => Shape.FromHost(context, ten, zero, p => marker != null));
            using (var other = new Context(new ContextOptions { Warning = (code, text) => marker.ToString() })) { }
            return new WeakReference(marker);
        }

        static void TestReleasedObjectsForgetTheirFunctions()
        {
            // Mono takes words on stacks for references, so some may be kept by chance.
            var forgotten = new List<WeakReference>();
            var thread = new Thread(() =>
            {
                for (int i = 0; i < 16; ++i) forgotten.Add(ForgottenFunction());
            });
            thread.Start();
            thread.Join();
            for (int i = 0; i < 20 && forgotten.Count(one => one.IsAlive) > 4; ++i)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
                Thread.Sleep(5);
            }
            True(forgotten.Count(one => one.IsAlive) <= 4);
        }

        static void TestWarnings()
        {
            var warnings = new List<WarningCode>();
            var options = new ContextOptions
            {
                Threads = 1,
                Warning = (code, message) =>
                {
                    True(message.Length > 10);
                    warnings.Add(code);
                    throw new OwnException(); // is lost
                }
            };
            using (var own = new Context(options))
            {
                Shape open = Shape.FromMesh(own, new[] { zero, new Vec3(6, 0, 0), new Vec3(0, 6, 0) }, new[] { 0, 1, 2 });
                Equal(3L, open.OpenEdgeCount);
            }
            True(warnings.SequenceEqual(new[] { WarningCode.OpenMesh }));
        }

        private static Slicer Long()
        {
            Structure foam = Structure.Foam(context, 0.5, 0.05);
            return new Slicer(new Model(context, Shape.Box(context, zero, ten), foam), new SlicerOptions(0.05, 0.05));
        }

        static void TestCancelFromACallback()
        {
            using (var source = new CancellationTokenSource())
            {
                var error = Throws<OperationCanceledException>(() => Long().Run(layer =>
                {
                    if (layer.Index == 2) source.Cancel();
                }, source.Token));
                Equal(source.Token, error.CancellationToken);
                Throws<OperationCanceledException>(() => Lattice().Membership(Points(3), source.Token));
            }
        }

        static void TestCancelFromAnotherThread()
        {
            using (var source = new CancellationTokenSource())
            using (var began = new ManualResetEventSlim())
            {
                var canceller = new Thread(() =>
                {
                    began.Wait();
                    source.Cancel();
                });
                canceller.Start();
                Throws<OperationCanceledException>(() => Long().Run(layer =>
                {
                    began.Set();
                    canceller.Join();
                }, source.Token));
            }
        }

        static void TestLayersLeftEarly()
        {
            using (var source = new CancellationTokenSource())
            {
                Slicer slicer = Long();
                Equal(3, slicer.Layers(source.Token).Take(3).Count());
                source.Cancel();
                Throws<OperationCanceledException>(() => slicer.Layers(source.Token).First());
            }
        }

        sealed class Recorder : IProgress<double>
        {
            internal readonly List<double> Values = new List<double>();
            internal Action<double> Then = value => { };

            public void Report(double value)
            {
                lock (Values) Values.Add(value);
                Then(value);
            }
        }

        static void TestProgress()
        {
            var progress = new Recorder();
            using (var reported = new ManualResetEventSlim())
            {
                progress.Then = value => reported.Set();
                Long().Run(0, 3, layer => True(layer.Index != 1 || reported.Wait(60000)), progress: progress);
            }
            lock (progress.Values)
            {
                Equal(1.0, progress.Values.Last());
                True(progress.Values.All(one => one >= 0 && one <= 1));
                True(progress.Values.Count >= 2); // one from a thread of the pool, while the callback waits
            }
        }

        static void TestProgressThatThrows()
        {
            var progress = new Recorder { Then = value => throw new OwnException() };
            Throws<OwnException>(() => Lattice().Membership(Points(3), progress: progress));
            Throws<OwnException>(() => Long().Run(layer => Thread.Sleep(5), progress: progress));
        }

        static void TestDocuments()
        {
            if (!Library.HasDocuments) return;
            string text = "{\"msq_model\": 1, \"title\": \"\u00fc\", \"scales\": [{\"shape\": {\"box\": " +
                "{\"min\": [0, 0, 0], \"max\": [10, 8, 6]}}}], \"slicing\": {\"pitch\": 0.5, \"layer_height\": 1.5}}";
            using (Document document = Document.FromJson(context, text))
            {
                Equal("\u00fc", document.Title);
                True(document.Model().Contains(new Vec3(5, 5, 5)));
                Equal(4L, document.Slicer().LayerCount);
            }
            var refused = Throws<MsqException>(() => Document.FromJson(context, ""));
            Equal(StatusCode.Argument, refused.Status);
            Throws<MsqException>(() => Document.FromFile(context, "no such file.json"));
        }

        static void TestManyThreads()
        {
            Slicer slicer = SlicerOf(Lattice());
            byte[][] wanted = slicer.Layers().Select(one => one.Data).ToArray();
            int wrong = 0;
            var threads = Enumerable.Range(0, 4).Select(seed => new Thread(() =>
            {
                var random = new Random(seed);
                for (int i = 0; i < 50; ++i)
                {
                    int index = random.Next(20);
                    if (!slicer.Layer(index).Data.SequenceEqual(wanted[index])) Interlocked.Increment(ref wrong);
                    string name = "MSQ_E_ARGUMENT: radius is -" + (seed + 1);
                    if (!Throws<MsqException>(() => Shape.Sphere(context, zero, -seed - 1)).Message
                             .StartsWith(name, StringComparison.Ordinal)) Interlocked.Increment(ref wrong);
                }
            })).ToArray();
            foreach (Thread one in threads) one.Start();
            foreach (Thread one in threads) one.Join();
            Equal(0, wrong);
        }

        static void TestMemoryReport()
        {
            using (var own = new Context(new ContextOptions { CacheBytes = 1 << 20, MemoryLimit = 1 << 26 }))
            {
                Shape box = Shape.Box(own, zero, ten);
                var model = new Model(own, box, Structure.Foam(own, 2, 0.2));
                new Slicer(model, new SlicerOptions(0.1, 0.1)).Run(layer => { });
                True(own.PeakMemoryBytes > 0 && own.PeakMemoryBytes <= 1 << 26 && own.MemoryBytes <= own.PeakMemoryBytes);
                own.ClearCache();
            }
        }
    }
}
