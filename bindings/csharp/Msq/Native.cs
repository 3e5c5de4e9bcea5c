// SPDX-License-Identifier: Apache-2.0
using System;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text;

namespace Msq.Interop
{
    public static unsafe partial class Abi
    {
        /// <summary>The loader makes libmsq.so, libmsq.dylib or msq.dll of it. Msq.dll.config maps it to
        /// libmsq.so.0 for Mono.</summary>
        public const string Library = "msq";

#if NET5_0_OR_GREATER
        // MSQ_LIBRARY names the file; else the loader looks for it; else for the name that a package of the
        // run-time library has.
        static Abi()
        {
            NativeLibrary.SetDllImportResolver(typeof(Abi).Assembly, Resolve);
        }

        private static IntPtr Resolve(string name, Assembly assembly, DllImportSearchPath? path)
        {
            if (name != Library) return IntPtr.Zero;
            string given = Environment.GetEnvironmentVariable("MSQ_LIBRARY");
            if (!string.IsNullOrEmpty(given)) return NativeLibrary.Load(given);
            IntPtr found;
            if (NativeLibrary.TryLoad(name, assembly, path, out found)) return found;
            return NativeLibrary.TryLoad("libmsq.so.0", assembly, path, out found) ? found : IntPtr.Zero;
        }
#endif

        /// <summary>A text of C in UTF-8; null for NULL.</summary>
        public static string Text(byte* text)
        {
            if (text == null) return null;
            int length = 0;
            while (text[length] != 0) ++length;
            var bytes = new byte[length];
            Marshal.Copy((IntPtr)text, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }
    }
}

namespace Msq
{
    using Msq.Interop;

    /// <summary>The loaded library.</summary>
    public static unsafe class Library
    {
        /// <summary>major * 10000 + minor * 100 + patch.</summary>
        public static int Version => (int)Abi.msq_version();
        /// <summary>SPDX licence of the binary with the libraries that it is built on.</summary>
        public static string Licence => Abi.Text(Info().licence);
        /// <summary>Instruction set that msq uses on this machine.</summary>
        public static string Simd => Abi.Text(Info().simd);
        /// <summary>Whether models have hashes.</summary>
        public static bool HasHashes => Info().with_xxhash != 0;
        /// <summary>Whether documents are read.</summary>
        public static bool HasDocuments => Info().with_json != 0;
        /// <summary>Whether all mesh formats are read.</summary>
        public static bool HasAllFormats => Info().with_assimp != 0;

        private static msq_build_report Info()
        {
            var report = new msq_build_report { struct_size = (uint)sizeof(msq_build_report) };
            MsqException.Check(Abi.msq_build_info(&report));
            return report;
        }
    }
}
