//! Memory of long numbers from the allocator of the program.
//!
//! Exact polynomials are made of millions of short-lived integers. GMP asks the C library for each of them, which took a fifth of the time
//! of a sweep of a six-bar more than the allocator of the program.
#![cfg(not(target_family = "wasm"))]
#![allow(unsafe_code, reason = "GMP takes its three functions as pointers, and there is no other way to name them")]

use gmp_mpfr_sys::gmp::set_memory_functions;
use std::alloc::{Layout, alloc, dealloc, handle_alloc_error, realloc};
use std::ffi::c_void;

/// Alignment of limbs and of pointers. Blocks of 40 bytes and the like are at hand in it, where 16 would make the allocator cut them out of larger
/// ones.
const ALIGNMENT: usize = 8;

/// Makes GMP and MPFR take their memory from the allocator of the program. It has to be called before the first long number is made: what the
/// C library gave cannot be returned to another allocator.
pub fn share_allocator() {
    // SAFETY: the three functions hold what GMP asks of them, and no number exists yet.
    unsafe { set_memory_functions(Some(allocate), Some(reallocate), Some(free)) }
}

/// Layout of memory of this size; sizes above those of all memory end the program as a lack of it does.
fn layout(size: usize) -> Layout {
    Layout::from_size_align(size.max(1), ALIGNMENT).unwrap_or_else(|_| handle_alloc_error(Layout::new::<c_void>()))
}

/// Returns the memory, or ends the program where there is none: GMP expects no null pointer.
fn some(memory: *mut u8, layout: Layout) -> *mut c_void {
    if memory.is_null() {
        handle_alloc_error(layout);
    }
    memory.cast()
}

extern "C" fn allocate(size: usize) -> *mut c_void {
    let layout = layout(size);
    // SAFETY: the size is not zero.
    some(unsafe { alloc(layout) }, layout)
}

unsafe extern "C" fn reallocate(memory: *mut c_void, old: usize, new: usize) -> *mut c_void {
    let (own, size) = (layout(old), new.max(1));
    // SAFETY: GMP passes memory that one of these functions gave, with the size that it asked for.
    some(unsafe { realloc(memory.cast(), own, size) }, layout(size))
}

unsafe extern "C" fn free(memory: *mut c_void, size: usize) {
    // SAFETY: as in `reallocate`.
    unsafe { dealloc(memory.cast(), layout(size)) }
}
