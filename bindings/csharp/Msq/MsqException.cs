// SPDX-License-Identifier: Apache-2.0
using System;
using Msq.Interop;

namespace Msq
{
    /// <summary>A call of msq failed. The message has the name of the status, the offending value and its
    /// limit.</summary>
    public sealed class MsqException : Exception
    {
        /// <summary>What went wrong.</summary>
        public StatusCode Status { get; }

        /// <summary>With StatusCode.Host: the code that a callback of the caller's own returned to msq; 0 if
        /// it wrote an invalid value.</summary>
        public int HostCode { get; }

        internal MsqException(StatusCode status, string message, int hostCode) : base(message)
        {
            Status = status;
            HostCode = hostCode;
        }

        /// <summary>Throws what a status says, for calls of Msq.Interop.Abi: right after the call, on the same
        /// thread. What a callback of this package threw is thrown again.</summary>
        public static unsafe void Check(int status)
        {
            if (status == Abi.MSQ_OK) return;
            int code = status == Abi.MSQ_E_HOST ? Abi.msq_error_host_code() : 0;
            Callbacks.Rethrow(code);
            string name = Abi.Text(Abi.msq_status_name(status));
            throw new MsqException((StatusCode)status, name + ": " + Abi.Text(Abi.msq_error_message()), code);
        }
    }
}
