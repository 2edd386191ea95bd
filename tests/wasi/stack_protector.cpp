// Debian's compiler builtins for WebAssembly refer to the stack protector, which wasi-libc lacks.
#if defined(__wasi__)
extern "C" {
unsigned long __stack_chk_guard = 0x5eed;
[[noreturn]] void __stack_chk_fail() {
  __builtin_trap();
}
}
#endif
