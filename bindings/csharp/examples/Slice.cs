// SPDX-License-Identifier: Apache-2.0
// Slices a box filled with a graded foam, asks points, and casts a ray.
using System;
using System.Linq;
using Msq;

static class Slice
{
    static void Main()
    {
        using (var context = new Context())
        using (var box = Shape.Box(context, new Vec3(0, 0, 0), new Vec3(20, 20, 10)))
        using (var radius = Field.Gradient(context, new Vec3(0, 0, 0), 0.1, new Vec3(0, 0, 10), 0.4))
        using (var foam = Structure.Foam(context, 2, radius))
        using (var model = new Model(context, box, foam))
        using (var slicer = new Slicer(model, new SlicerOptions(pitch: 0.05, layerHeight: 0.5)))
        {
            // As a callback: msq computes the next layers meanwhile.
            slicer.Run(layer =>
            {
                if (layer.Index % 5 != 0) return;
                double share = 100.0 * layer.InsideCount / ((long)layer.Width * layer.Height);
                Console.WriteLine(FormattableString.Invariant($"z = {layer.Z}: {share:F1} % solid"));
            });
            // As a sequence, which may be left at any time.
            Layer first = slicer.Layers().First(layer => layer.IsInside(100, 100));
            Console.WriteLine("pixel (100, 100) is solid in layer " + first.Index);

            var points = new[] { new Vec3(10, 10, 5), new Vec3(-1, 10, 5) };
            Console.WriteLine(string.Join(" ", model.Membership(points)));
            RayHit hit = model.CastRays(new[] { new Vec3(10, 10, 20) }, new[] { new Vec3(0, 0, -1) })[0];
            Console.WriteLine(hit.IsHit ? "the ray hits scale " + hit.Scale : "the ray hits nothing");
            try
            {
                Shape.Sphere(context, new Vec3(0, 0, 0), -1);
            }
            catch (MsqException error)
            {
                Console.WriteLine("refused: " + error.Message);
            }
        }
    }
}
