// SPDX-License-Identifier: Apache-2.0
using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Threading.Tasks;
using Msq.Interop;

namespace Msq
{
    /// <summary>Unity's compiler to C++ takes methods with an attribute of this name as callbacks of C.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        internal MonoPInvokeCallbackAttribute(Type type) { Type = type; }
        internal Type Type { get; }
    }

    /// <summary>The functions that msq calls. They are static, and so are their delegates: they live as long as
    /// the program. The object of a call, or that of a host object, comes as `user`. No exception leaves them:
    /// it is stored under a code of its own, which msq carries through, and thrown again by the thread that
    /// called msq.</summary>
    internal static unsafe class Callbacks
    {
        private struct Failure
        {
            internal int Code;
            internal ExceptionDispatchInfo Info;
        }

        // Where several threads fail in one call, msq carries one code. The others stay until they are the oldest.
        private const int MaxFailures = 256;
        private static readonly List<Failure> failures = new List<Failure>(); // also the lock
        private static int count;

        private static int Keep(Exception error)
        {
            var failure = new Failure { Info = ExceptionDispatchInfo.Capture(error) };
            lock (failures)
            {
                count = (count + 1) & 0x3fffffff;
                failure.Code = int.MinValue + count;
                if (failures.Count == MaxFailures) failures.RemoveAt(0);
                failures.Add(failure);
            }
            return failure.Code;
        }

        internal static void Rethrow(int code)
        {
            Failure found;
            lock (failures)
            {
                int index = failures.FindLastIndex(one => one.Code == code);
                if (index < 0) return;
                found = failures[index];
                failures.RemoveAt(index);
            }
            found.Info.Throw();
        }

        private static T Of<T>(void* user) where T : class => (T)GCHandle.FromIntPtr((IntPtr)user).Target;

        private static readonly msq_layer_fn takeLayer = TakeLayer;
        internal static readonly IntPtr Layer = Marshal.GetFunctionPointerForDelegate(takeLayer);

        [MonoPInvokeCallback(typeof(msq_layer_fn))]
        private static int TakeLayer(void* user, msq_layer* layer)
        {
            LayerView view = null;
            try
            {
                view = new LayerView(layer);
                Of<Action<LayerView>>(user)(view);
                return 0;
            }
            catch (Exception error)
            {
                return Keep(error);
            }
            finally
            {
                view?.Close();
            }
        }

        private static readonly msq_surface_fn takeSlab = TakeSlab;
        internal static readonly IntPtr Slab = Marshal.GetFunctionPointerForDelegate(takeSlab);

        [MonoPInvokeCallback(typeof(msq_surface_fn))]
        private static int TakeSlab(void* user, msq_surface_slab* slab)
        {
            try
            {
                Of<MeshParts>(user).Add(slab);
                return 0;
            }
            catch (Exception error)
            {
                return Keep(error);
            }
        }

        /// <summary>The functions behind a field, shape or structure of the caller.</summary>
        internal sealed class Host
        {
            internal Func<Vec3, bool> Inside;
            internal Func<Vec3, double> Value;
        }

        private static readonly bool isMono = Type.GetType("Mono.Runtime") != null;

        /// <summary>The member `concurrent` of a definition. A thread of msq becomes one of the run time by its
        /// first callback, and at the end of a program Mono waits for it in vain.</summary>
        internal static int Concurrent(Context context, bool concurrent)
        {
            if (concurrent && isMono && context != null && !context.UsesThreadPool)
                throw new NotSupportedException("on Mono concurrent = true needs a context with UseThreadPool");
            return concurrent ? 1 : 0;
        }

        private static readonly msq_values_fn evaluate = Evaluate;
        internal static readonly IntPtr Values = Marshal.GetFunctionPointerForDelegate(evaluate);

        [MonoPInvokeCallback(typeof(msq_values_fn))]
        private static int Evaluate(void* user, double* points, ulong count, double* values)
        {
            try
            {
                Func<Vec3, double> value = Of<Host>(user).Value;
                for (ulong i = 0; i < count; ++i) values[i] = value(((Vec3*)points)[i]);
                return 0;
            }
            catch (Exception error)
            {
                return Keep(error);
            }
        }

        private static readonly msq_inside_fn decide = Decide;
        internal static readonly IntPtr Inside = Marshal.GetFunctionPointerForDelegate(decide);

        [MonoPInvokeCallback(typeof(msq_inside_fn))]
        private static int Decide(void* user, double* points, ulong count, byte* inside)
        {
            try
            {
                Func<Vec3, bool> value = Of<Host>(user).Inside;
                for (ulong i = 0; i < count; ++i) inside[i] = value(((Vec3*)points)[i]) ? (byte)1 : (byte)0;
                return 0;
            }
            catch (Exception error)
            {
                return Keep(error);
            }
        }

        private static readonly msq_parallel_for_fn share = Share;
        internal static readonly IntPtr ParallelFor = Marshal.GetFunctionPointerForDelegate(share);
        private static readonly ConcurrentDictionary<IntPtr, msq_task_fn> bodies =
            new ConcurrentDictionary<IntPtr, msq_task_fn>(); // a few functions of msq

        [MonoPInvokeCallback(typeof(msq_parallel_for_fn))]
        private static int Share(void* user, ulong tasks, IntPtr body, void* task)
        {
            try
            {
                msq_task_fn run = bodies.GetOrAdd(body, Marshal.GetDelegateForFunctionPointer<msq_task_fn>);
                var given = (IntPtr)task;
                Parallel.For(0, (long)tasks, i => run((void*)given, (ulong)i));
                return 0;
            }
            catch (Exception error)
            {
                return Keep(error);
            }
        }

        private static readonly msq_warning_fn warn = Warn;
        internal static readonly IntPtr Warning = Marshal.GetFunctionPointerForDelegate(warn);

        [MonoPInvokeCallback(typeof(msq_warning_fn))]
        private static void Warn(void* user, int code, byte* message)
        {
            try
            {
                Of<Action<WarningCode, string>>(user)((WarningCode)code, Abi.Text(message));
            }
            catch (Exception)
            {
                // msq has no way to stop a call by a warning.
            }
        }

        private static readonly msq_release_fn release = Free;
        internal static readonly IntPtr Release = Marshal.GetFunctionPointerForDelegate(release);

        [MonoPInvokeCallback(typeof(msq_release_fn))]
        private static void Free(void* user) => GCHandle.FromIntPtr((IntPtr)user).Free();

        /// <summary>`user` of an object that lives until msq calls Release.</summary>
        internal static void* Hold(object user) => (void*)GCHandle.ToIntPtr(GCHandle.Alloc(user));

        /// <summary>Throws what the status of a constructor says. msq does not release what it refused.</summary>
        internal static void Check(int status, void* user)
        {
            if (status != Abi.MSQ_OK && user != null) Free(user);
            MsqException.Check(status);
        }
    }
}
