//! Lets the libraries that the program loads under Linux take their memory from its own allocator.
//!
//! Graphics drivers come at run time. What they allocate for a large plant would lie among the pieces of the system's
//! allocator, which hands little of it back when the plant is gone. mimalloc (its feature `override`) defines the C
//! functions for memory, and hands back what is free. A library must find all of them in the program, or memory from one
//! allocator would be freed by the other; the linker shows by itself only those that the program's own libraries use.

#![allow(clippy::print_stdout, reason = "cargo reads it there")]

/// Functions whose memory is freed by `free`, or which ask of a block how large it is.
const FUNCTIONS: [&str; 12] = [
    "malloc",
    "calloc",
    "realloc",
    "reallocarray",
    "free",
    "cfree",
    "aligned_alloc",
    "memalign",
    "posix_memalign",
    "valloc",
    "pvalloc",
    "malloc_usable_size",
];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let set = |name: &str| std::env::var(name).unwrap_or_default();
    if set("CARGO_CFG_TARGET_OS") == "linux" && !set("CARGO_FEATURE_PROGRAM").is_empty() {
        for function in FUNCTIONS {
            println!("cargo::rustc-link-arg=-Wl,--export-dynamic-symbol={function}");
        }
    }
}
