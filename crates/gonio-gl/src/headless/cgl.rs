//! CGL, the part of macOS's OpenGL that needs no window and works in every thread. Type-checked only: gonio was not run on macOS.
//!
//! AppKit's contexts, which the window uses, wait for the first thread, and that one waits for the thread that draws.
#![allow(unsafe_code)]

use super::HeadlessOptions;
use crate::{GlError, Remedy};
use libloading::Library;
use std::ffi::{c_int, c_void};
use std::mem::ManuallyDrop;
use std::ptr;

/// OpenGL of the system, with CGL. It is on every macOS, though deprecated.
const LIBRARY: &str = "/System/Library/Frameworks/OpenGL.framework/OpenGL";

/// CGLPixelFormatAttribute
const COLOR_SIZE: c_int = 8;
const ALLOW_OFFLINE_RENDERERS: c_int = 96;
const OPENGL_PROFILE: c_int = 99;
/// CGLOpenGLProfile: 3.3 to 4.1 core
const PROFILE_3_2_CORE: c_int = 0x3200;

type ChoosePixelFormat = unsafe extern "C" fn(*const c_int, *mut *mut c_void, *mut c_int) -> c_int;
type CreateContext = unsafe extern "C" fn(*mut c_void, *mut c_void, *mut *mut c_void) -> c_int;
type OfOne = unsafe extern "C" fn(*mut c_void) -> c_int;

/// A current context, destroyed when this is dropped.
pub struct HeadlessPlatform {
    context: *mut c_void,
    set_current: OfOne,
    destroy: OfOne,
    /// Never unloaded: the driver's threads outlive contexts.
    library: ManuallyDrop<Library>,
}

impl HeadlessPlatform {
    pub fn new(_options: &HeadlessOptions) -> Result<Self, GlError> {
        let missing = |error| GlError::new(format!("no OpenGL: {LIBRARY} does not load ({error})"));
        // SAFETY: loading a library runs its initialisers; the system's OpenGL is made to be loaded. The types are those of CGL's
        // header, CGL.h.
        let (library, choose, create, destroy_format, set_current, destroy) = unsafe {
            let library = Library::new(LIBRARY).map_err(missing)?;
            let choose: ChoosePixelFormat = *library.get(b"CGLChoosePixelFormat\0").map_err(missing)?;
            let create: CreateContext = *library.get(b"CGLCreateContext\0").map_err(missing)?;
            let destroy_format: OfOne = *library.get(b"CGLDestroyPixelFormat\0").map_err(missing)?;
            let set_current: OfOne = *library.get(b"CGLSetCurrentContext\0").map_err(missing)?;
            let destroy: OfOne = *library.get(b"CGLDestroyContext\0").map_err(missing)?;
            (ManuallyDrop::new(library), choose, create, destroy_format, set_current, destroy)
        };
        let attributes = [OPENGL_PROFILE, PROFILE_3_2_CORE, COLOR_SIZE, 24, ALLOW_OFFLINE_RENDERERS, 0];
        let (mut format, mut count, mut context) = (ptr::null_mut(), 0, ptr::null_mut());
        // SAFETY: the attributes end with 0, and each function writes to the place of the type that it names. The format is freed
        // once, the context in `drop`.
        let error = unsafe {
            match choose(attributes.as_ptr(), &mut format, &mut count) {
                0 if !format.is_null() => {
                    let error = create(format, ptr::null_mut(), &mut context);
                    destroy_format(format);
                    if error == 0 { set_current(context) } else { error }
                }
                error => error,
            }
        };
        if error != 0 || context.is_null() {
            return Err(GlError::new(format!(
                "no OpenGL: the system refused a context of OpenGL 3.3 (CGL error {error})"
            ))
            .with_remedy(Remedy::CpuRenderer));
        }
        Ok(HeadlessPlatform { context, set_current, destroy, library })
    }

    /// The functions of the context, which is current.
    pub fn functions(&self) -> glow::Context {
        // SAFETY: `new` has made the context current on this thread, and the library has the functions of every context.
        unsafe { glow::Context::from_loader_function(|name| self.address_of(name)) }
    }

    /// The address of a function; null where there is none of that name.
    fn address_of(&self, name: &str) -> *const c_void {
        // SAFETY: only the address is taken; the caller knows its type.
        unsafe { self.library.get::<*const c_void>(name.as_bytes()) }.map_or(ptr::null(), |symbol| *symbol)
    }
}

impl Drop for HeadlessPlatform {
    fn drop(&mut self) {
        // SAFETY: the context was made by `new`, is current on this thread if on any, and is destroyed once.
        unsafe {
            (self.set_current)(ptr::null_mut());
            (self.destroy)(self.context);
        }
    }
}
