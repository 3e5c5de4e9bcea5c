// SPDX-License-Identifier: Apache-2.0
// Runs the vectors through the package: see tests/vectors/protocol.py.
using System;
using System.IO;
using System.Linq;
using System.Text;

namespace Msq.Tests
{
    static class Vectors
    {
        internal static int Run(string[] arguments)
        {
            using (var output = new StreamWriter(Console.OpenStandardOutput(), new UTF8Encoding(false)))
            using (var context = new Context())
            {
                output.NewLine = "\n";
                for (int i = 1; i + 1 < arguments.Length; i += 2)
                {
                    output.WriteLine("case");
                    try
                    {
                        Document document = Document.FromJson(context, File.ReadAllText(arguments[i], Encoding.UTF8));
                        Print(output, document, PointsOf(File.ReadAllBytes(arguments[i + 1])));
                    }
                    catch (MsqException error)
                    {
                        output.WriteLine("refused " + error.Message);
                    }
                }
            }
            return 0;
        }

        private static void Print(TextWriter output, Document document, double[] points)
        {
            output.WriteLine("title " + document.Title);
            Model model = document.Model();
            output.WriteLine("hash " + (Library.HasHashes ? model.Hash : "-"));
            output.WriteLine("inside " + string.Concat(model.Membership(points).Select(one => one ? '1' : '0')));
            output.WriteLine("distance " + string.Join(" ", model.Distance(points).Select(Bits)));
            Slicer slicer = document.Slicer();
            output.WriteLine("plan {0} {1} {2}", slicer.Width, slicer.Height, slicer.LayerCount);
            slicer.Run(layer => output.WriteLine("layer {0} {1} {2}", layer.Index, Bits(layer.Z),
                                                 Hex(layer.Copy().Data)));
        }

        private static double[] PointsOf(byte[] data)
        {
            var points = new double[data.Length / sizeof(double)];
            Buffer.BlockCopy(data, 0, points, 0, points.Length * sizeof(double));
            return points;
        }

        private static string Bits(double value) => BitConverter.DoubleToInt64Bits(value).ToString("x16");
        private static string Hex(byte[] data) => BitConverter.ToString(data).Replace("-", "");
    }
}
