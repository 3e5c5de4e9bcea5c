// SPDX-License-Identifier: Apache-2.0
using System;
using Msq.Interop;

namespace Msq
{
    /// <summary>Settings of a context.</summary>
    public sealed class ContextOptions
    {
        /// <summary>Threads per call, with the caller; 0: one per core.</summary>
        public int Threads { get; set; }
        /// <summary>Size of the cell cache in bytes; null: 1 GiB; 0: none.</summary>
        public long? CacheBytes { get; set; }
        /// <summary>Limit of the memory accounted to the context; 0: none.</summary>
        public long MemoryLimit { get; set; }
        public CachePolicy CachePolicy { get; set; }
        /// <summary>Runs the loops of msq by Parallel.For, on the thread pool of .NET. msq then starts no threads
        /// of its own.</summary>
        public bool UseThreadPool { get; set; }
        /// <summary>Receives warnings, on the thread that called msq. It must not throw: what it throws is
        /// lost.</summary>
        public Action<WarningCode, string> Warning { get; set; }
    }

    /// <summary>Threads, cell cache and memory limit that objects share.</summary>
    public sealed unsafe class Context : Handle
    {
        public Context(ContextOptions options = null) : base(Create(options ?? new ContextOptions()))
        {
            UsesThreadPool = options != null && options.UseThreadPool;
        }

        /// <summary>As in the options.</summary>
        public bool UsesThreadPool { get; }

        private static msq_context* Create(ContextOptions options)
        {
            msq_context_def def = msq_context_def.Defaults();
            def.threads = Call.Unsigned(options.Threads, nameof(options.Threads));
            if (options.CacheBytes.HasValue)
                def.cache_bytes = Call.Unsigned(options.CacheBytes.Value, nameof(options.CacheBytes));
            def.memory_limit = Call.Unsigned(options.MemoryLimit, nameof(options.MemoryLimit));
            def.cache_policy = (int)options.CachePolicy;
            if (options.UseThreadPool) def.parallel_for = Callbacks.ParallelFor;
            if (options.Warning != null)
            {
                def.warning = Callbacks.Warning;
                def.warning_user = Callbacks.Hold(options.Warning);
                def.warning_release = Callbacks.Release;
            }
            msq_context* made;
            Callbacks.Check(Abi.msq_context_create(&def, &made), def.warning_user);
            return made;
        }

        /// <summary>Bytes that meshes, images, slabs and cached cells hold now.</summary>
        public long MemoryBytes => (long)Memory().bytes;
        /// <summary>Their maximum so far.</summary>
        public long PeakMemoryBytes => (long)Memory().peak_bytes;

        private msq_memory_report Memory()
        {
            var report = new msq_memory_report { struct_size = (uint)sizeof(msq_memory_report) };
            using (var call = new Call()) call.Check(Abi.msq_context_memory(call.Use(this), &report));
            return report;
        }

        /// <summary>Drops all cached cells.</summary>
        public void ClearCache()
        {
            using (var call = new Call()) call.Check(Abi.msq_cache_clear(call.Use(this)));
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_context_release((msq_context*)handle);
            return true;
        }
    }
}
