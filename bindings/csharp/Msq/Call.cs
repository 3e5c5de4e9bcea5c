// SPDX-License-Identifier: Apache-2.0
using System;
using System.Collections.Generic;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Text;
using System.Threading;
using Msq.Interop;

namespace Msq
{
    /// <summary>What one call of msq needs until it returns: handles that nobody may release meanwhile, pinned
    /// arrays and texts, the objects behind callbacks, and a job.</summary>
    internal sealed unsafe class Call : IDisposable
    {
        private const int Period = 50; // milliseconds from one report of progress to the next
        private readonly List<SafeHandle> used = new List<SafeHandle>();
        private List<GCHandle> pinned;
        private readonly Job job;
        private readonly CancellationToken cancel;
        private CancellationTokenRegistration registration;
        private readonly IProgress<double> progress;
        private readonly Timer timer;
        private volatile bool over;
        private volatile ExceptionDispatchInfo failure; // of progress

        internal Call() { }

        internal Call(CancellationToken cancel, IProgress<double> progress)
        {
            cancel.ThrowIfCancellationRequested();
            if (cancel.CanBeCanceled || progress != null)
            {
                this.cancel = cancel;
                this.progress = progress;
                job = new Job();
                registration = cancel.Register(job.Cancel);
                if (progress != null) timer = new Timer(Report, null, Period, Period);
            }
        }

        internal msq_job* Job => job == null ? null : (msq_job*)Use(job, "job");

        /// <summary>The pointer of an object, which is kept until the call is over.</summary>
        internal void* Use(Handle handle, string name)
        {
            if (handle == null) throw new ArgumentNullException(name);
            bool isKept = false;
            handle.DangerousAddRef(ref isKept);
            used.Add(handle);
            return (void*)handle.DangerousGetHandle();
        }

        internal msq_context* Use(Context context) => (msq_context*)Use(context, nameof(context));

        /// <summary>The address of an array, which is pinned until the call is over; null of none and of an empty one.</summary>
        internal void* Pin(Array array)
        {
            if (array == null || array.Length == 0) return null;
            return (void*)Keep(GCHandle.Alloc(array, GCHandleType.Pinned)).AddrOfPinnedObject();
        }

        /// <summary>A text in UTF-8 with a 0 at its end.</summary>
        internal byte* Text(string text, string name)
        {
            if (text == null) return null;
            if (text.IndexOf('\0') >= 0) throw new ArgumentException(name + " has a character 0", name);
            return (byte*)Pin(Encoding.UTF8.GetBytes(text + "\0"));
        }

        /// <summary>A number that must not be negative.</summary>
        internal static ulong Unsigned(long value, string name)
        {
            if (value < 0)
                throw new ArgumentOutOfRangeException(name, name + " is " + value + "; it must be at least 0");
            return (ulong)value;
        }

        internal static uint Unsigned(int value, string name) => (uint)Unsigned((long)value, name);

        /// <summary>What a callback gets as `user`.</summary>
        internal void* User(object user) => (void*)GCHandle.ToIntPtr(Keep(GCHandle.Alloc(user)));

        private GCHandle Keep(GCHandle made)
        {
            if (pinned == null) pinned = new List<GCHandle>();
            pinned.Add(made);
            return made;
        }

        /// <summary>Throws what the status of the call says.</summary>
        internal void Check(int status)
        {
            if (status == Abi.MSQ_E_CANCELLED)
            {
                failure?.Throw();
                if (cancel.IsCancellationRequested)
                    throw new OperationCanceledException(Abi.Text(Abi.msq_error_message()), cancel);
            }
            MsqException.Check(status);
        }

        /// <summary>The result of a call that was successful, and the last report of progress.</summary>
        internal T Done<T>(T result)
        {
            over = true;
            failure?.Throw();
            progress?.Report(1);
            return result;
        }

        // On a thread of the pool.
        private void Report(object state)
        {
            try
            {
                double fraction = 0;
                using (var call = new Call())
                    if (Abi.msq_job_progress((msq_job*)call.Use(job, "job"), &fraction) != Abi.MSQ_OK) return;
                if (!over) progress.Report(fraction);
            }
            catch (ObjectDisposedException) when (over)
            {
            }
            catch (Exception error)
            {
                failure = ExceptionDispatchInfo.Capture(error);
                over = true;
                if (!job.IsClosed) job.Cancel();
            }
        }

        public void Dispose()
        {
            over = true;
            timer?.Dispose();
            registration.Dispose();
            foreach (SafeHandle handle in used) handle.DangerousRelease();
            if (pinned != null)
                foreach (GCHandle one in pinned) one.Free();
            job?.Dispose();
        }
    }
}
