// SPDX-License-Identifier: Apache-2.0
using System;
using System.Runtime.InteropServices;
using Msq.Interop;

namespace Msq
{
    /// <summary>An object of msq: immutable, for any number of threads at the same time. It is released by
    /// Dispose, or when it is collected; objects that were made of it live on. DangerousGetHandle gives the
    /// pointer for calls of Msq.Interop.Abi.</summary>
    public abstract unsafe class Handle : SafeHandle
    {
        internal Handle(void* made) : base(IntPtr.Zero, true)
        {
            SetHandle((IntPtr)made);
        }

        /// <summary>Whether there is no object.</summary>
        public override bool IsInvalid => handle == IntPtr.Zero;

        internal static string Hex(byte* hash)
        {
            const string digits = "0123456789abcdef";
            var text = new char[32];
            for (int i = 0; i < 32; ++i) text[i] = digits[(hash[i / 2] >> (i % 2 == 0 ? 4 : 0)) & 15];
            return new string(text);
        }
    }

    internal sealed unsafe class Job : Handle
    {
        internal Job() : base(Create()) { }

        private static msq_job* Create()
        {
            msq_job* made;
            MsqException.Check(Abi.msq_job_create(&made));
            return made;
        }

        /// <summary>From any thread, at any time: nothing happens to a job that is over.</summary>
        internal void Cancel()
        {
            using (var call = new Call()) Abi.msq_job_cancel((msq_job*)call.Use(this, "job"));
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_job_release((msq_job*)handle);
            return true;
        }
    }
}
