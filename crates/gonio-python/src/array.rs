//! Numbers that Python sees as a buffer, and NumPy as an array, without a copy.

// A buffer is a C structure that is filled in place.
#![allow(unsafe_code)]

use pyo3::exceptions::PyBufferError;
use pyo3::ffi;
use pyo3::prelude::*;
use std::ffi::{CStr, c_int, c_void};

/// The numbers of an array.
pub enum Numbers {
    /// Linear RGBA.
    Pixels(Vec<[f32; 4]>),
    /// 8 bits a channel.
    Bytes(Vec<u8>),
    /// Values of a function.
    Values(Vec<f64>),
}

impl Numbers {
    /// The format of `struct`, and the bytes of a number.
    fn format(&self) -> (&'static CStr, isize) {
        match self {
            Numbers::Pixels(_) => (c"f", 4),
            Numbers::Bytes(_) => (c"B", 1),
            Numbers::Values(_) => (c"d", 8),
        }
    }

    fn count(&self) -> usize {
        match self {
            Numbers::Pixels(pixels) => 4 * pixels.len(),
            Numbers::Bytes(bytes) => bytes.len(),
            Numbers::Values(values) => values.len(),
        }
    }

    fn start(&self) -> *const c_void {
        match self {
            Numbers::Pixels(pixels) => pixels.as_ptr().cast(),
            Numbers::Bytes(bytes) => bytes.as_ptr().cast(),
            Numbers::Values(values) => values.as_ptr().cast(),
        }
    }
}

/// An array of three dimensions in C's order. Nobody can write to it, so threads may read it without Python's lock.
#[pyclass(frozen, module = "gonio._native")]
pub struct NativeArray {
    numbers: Numbers,
    shape: [ffi::Py_ssize_t; 3],
    strides: [ffi::Py_ssize_t; 3],
}

impl NativeArray {
    /// The array of this shape; `None` if the numbers are more or fewer.
    pub fn new(numbers: Numbers, shape: [usize; 3]) -> Option<Self> {
        let count = shape.iter().try_fold(1_usize, |count, side| count.checked_mul(*side))?;
        if count != numbers.count() {
            return None;
        }
        let (_, size) = numbers.format();
        let shape = shape.map(|side| side as ffi::Py_ssize_t);
        let strides = [shape[1] * shape[2] * size, shape[2] * size, size];
        Some(NativeArray { numbers, shape, strides })
    }

    /// The pixels, where the array has pixels.
    pub fn pixels(&self) -> &[[f32; 4]] {
        match &self.numbers {
            Numbers::Pixels(pixels) => pixels,
            Numbers::Bytes(_) | Numbers::Values(_) => &[],
        }
    }
}

#[pymethods]
impl NativeArray {
    /// Fills in `view` for a reader.
    ///
    /// # Safety
    ///
    /// Python calls it with a `view` to be filled in.
    unsafe fn __getbuffer__(slf: Bound<'_, Self>, view: *mut ffi::Py_buffer, flags: c_int) -> PyResult<()> {
        if view.is_null() {
            return Err(PyBufferError::new_err("there is no buffer to fill in"));
        }
        if flags & ffi::PyBUF_WRITABLE == ffi::PyBUF_WRITABLE {
            // SAFETY: Python gives a pointer to a structure that lives until this function returns.
            unsafe { (*view).obj = std::ptr::null_mut() };
            return Err(PyBufferError::new_err("the array is read-only; `.copy()` makes one that can be changed"));
        }
        let array = slf.get();
        let (format, itemsize) = array.numbers.format();
        let asked = |flag: c_int| flags & flag == flag;
        // SAFETY: as above. The pointers lead to the numbers, the shape and the strides of the object, which never change and
        // live as long as the reference to it in `obj`; Python releases that when the reader has finished. Nobody writes through
        // them, because the buffer is marked as read-only.
        unsafe {
            let view = &mut *view;
            view.buf = array.numbers.start().cast_mut();
            view.len = array.numbers.count() as ffi::Py_ssize_t * itemsize;
            view.readonly = 1;
            view.itemsize = itemsize;
            view.format = if asked(ffi::PyBUF_FORMAT) { format.as_ptr().cast_mut() } else { std::ptr::null_mut() };
            view.ndim = 3;
            view.shape = if asked(ffi::PyBUF_ND) { array.shape.as_ptr().cast_mut() } else { std::ptr::null_mut() };
            view.strides =
                if asked(ffi::PyBUF_STRIDES) { array.strides.as_ptr().cast_mut() } else { std::ptr::null_mut() };
            view.suboffsets = std::ptr::null_mut();
            view.internal = std::ptr::null_mut();
            view.obj = slf.into_any().into_ptr();
        }
        Ok(())
    }
}
