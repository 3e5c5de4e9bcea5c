// SPDX-License-Identifier: Apache-2.0
// Prints what check_layout.py compares with abi.json: structs, their members, constants, enums, callbacks and functions.
using System;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using Msq.Interop;

namespace Msq.Tests
{
    static class Layout
    {
        internal static int Print()
        {
            foreach (Type type in typeof(Abi).Assembly.GetTypes())
            {
                if (type.Namespace == "Msq" && type.IsEnum && type.IsPublic)
                {
                    foreach (object value in Enum.GetValues(type))
                        Console.WriteLine("enum {0} {1} {2}", type.Name, value, (int)value);
                }
                else if (type.Namespace == "Msq.Interop" && type.IsValueType && !type.IsNested)
                {
                    FieldInfo[] fields = type.GetFields(BindingFlags.Instance | BindingFlags.Public);
                    if (fields.Length == 0) continue; // handles
                    Console.WriteLine("struct {0} {1}", type.Name, Marshal.SizeOf(type));
                    foreach (FieldInfo field in fields)
                        Console.WriteLine("field {0} {1} {2} {3}", type.Name, field.Name,
                                          Marshal.OffsetOf(type, field.Name), Size(field));
                }
                else if (type.Namespace == "Msq.Interop" && typeof(Delegate).IsAssignableFrom(type))
                {
                    Console.WriteLine("callback {0} {1}", type.Name, Signature(type.GetMethod("Invoke")));
                }
            }
            foreach (FieldInfo field in typeof(Abi).GetFields(BindingFlags.Static | BindingFlags.Public))
                if (field.Name.StartsWith("MSQ_", StringComparison.Ordinal))
                    Console.WriteLine("constant {0} {1}", field.Name, field.GetRawConstantValue());
            foreach (MethodInfo method in typeof(Abi).GetMethods(BindingFlags.Static | BindingFlags.Public))
                if (method.Name.StartsWith("msq_", StringComparison.Ordinal))
                    Console.WriteLine("function {0} {1}", method.Name, Signature(method));
            return 0;
        }

        private static string Signature(MethodInfo method) => string.Join(
            " ", new[] { method.ReturnType }.Concat(method.GetParameters().Select(one => one.ParameterType))
                     .Select(type => type.Name));

        // In bytes. An array of C is a struct of the size of the array.
        private static int Size(FieldInfo field)
        {
            if (field.FieldType.IsPointer || field.FieldType == typeof(IntPtr)) return IntPtr.Size;
            var array = field.GetCustomAttribute<System.Runtime.CompilerServices.FixedBufferAttribute>();
            return array == null ? Marshal.SizeOf(field.FieldType) : array.Length * Marshal.SizeOf(array.ElementType);
        }
    }
}
