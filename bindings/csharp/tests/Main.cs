// SPDX-License-Identifier: Apache-2.0
// usage: Tests.exe tests | layout | vectors MODEL POINTS ...
using System;

namespace Msq.Tests
{
    static class Program
    {
        static int Main(string[] arguments)
        {
            switch (arguments.Length > 0 ? arguments[0] : "")
            {
                case "tests": return Tests.Run();
                case "layout": return Layout.Print();
                case "vectors": return Vectors.Run(arguments);
                default:
                    Console.Error.WriteLine("usage: Tests.exe tests | layout | vectors MODEL POINTS ...");
                    return 2;
            }
        }
    }
}
