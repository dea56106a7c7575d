//! WGL on a hidden window: Windows has no OpenGL without one.
//!
//! The window is the system's, not winit's. winit makes one event loop in a process, and only in its first thread; a check draws in a
//! thread with a large stack, and some commands make several contexts.
#![allow(unsafe_code)]

use super::HeadlessOptions;
use crate::GlError;
use glutin::config::ConfigTemplateBuilder;
use glutin::context::{ContextApi, ContextAttributesBuilder, GlProfile, PossiblyCurrentContext, Version};
use glutin::display::{Display, DisplayApiPreference, GetGlDisplay};
use glutin::prelude::*;
use glutin::surface::{Surface, SurfaceAttributesBuilder, WindowSurface};
use raw_window_handle::{RawDisplayHandle, RawWindowHandle, Win32WindowHandle, WindowsDisplayHandle};
use std::ffi::{CString, c_void};
use std::num::{NonZeroIsize, NonZeroU32};
use std::ptr;
use windows_sys::Win32::Foundation::HWND;
use windows_sys::Win32::System::LibraryLoader::GetModuleHandleW;
use windows_sys::Win32::UI::WindowsAndMessaging::{
    CS_OWNDC, CreateWindowExW, DefWindowProcW, DestroyWindow, RegisterClassW, WNDCLASSW,
};
use windows_sys::w;

/// A context on a hidden window. Fields are dropped in this order: the window last.
pub struct HeadlessPlatform {
    context: PossiblyCurrentContext,
    _surface: Surface<WindowSurface>,
    _window: HiddenWindow,
}

impl HeadlessPlatform {
    pub fn new(options: &HeadlessOptions) -> Result<Self, GlError> {
        let failed =
            |problem: &str, error: &dyn std::fmt::Display| GlError::new(format!("no OpenGL: {problem} ({error})"));
        let window = HiddenWindow::new().map_err(|e| failed("cannot create a hidden window", &e))?;
        let handle = window.handle;
        let windows = RawDisplayHandle::Windows(WindowsDisplayHandle::new());
        // SAFETY: the handle is that of `window`, of this module.
        let display = unsafe { Display::new(windows, DisplayApiPreference::Wgl(Some(handle))) }
            .map_err(|e| failed("WGL does not start", &e))?;
        let template = ConfigTemplateBuilder::new().compatible_with_native_window(handle).build();
        // SAFETY: the template names `window`, which exists.
        let config = unsafe { display.find_configs(template) }
            .map_err(|e| failed("no pixel format of the window has OpenGL", &e))?
            .next()
            .ok_or_else(|| GlError::new("no OpenGL: no pixel format of the window has it"))?;
        let attributes = ContextAttributesBuilder::new()
            .with_profile(GlProfile::Core)
            .with_context_api(ContextApi::OpenGl(Some(Version::new(3, 3))))
            .with_debug(options.debug)
            .build(Some(handle));
        // The surface first: it gives the window its pixel format.
        let sizes = SurfaceAttributesBuilder::<WindowSurface>::new().build(handle, NonZeroU32::MIN, NonZeroU32::MIN);
        // SAFETY: the handle belongs to `window`, which lives as long as surface and context do.
        let surface = unsafe { config.display().create_window_surface(&config, &sizes) }
            .map_err(|e| failed("the hidden window cannot be drawn to", &e))?;
        // SAFETY: as above.
        let context = unsafe { config.display().create_context(&config, &attributes) }
            .map_err(|e| failed("the driver refused a context of OpenGL 3.3", &e))?;
        let context = context.make_current(&surface).map_err(|e| failed("the context cannot be made current", &e))?;
        Ok(HeadlessPlatform { context, _surface: surface, _window: window })
    }

    /// The functions of the context, which is current.
    pub fn functions(&self) -> glow::Context {
        // SAFETY: `new` has made the context current on this thread, so these are that context's functions.
        unsafe { glow::Context::from_loader_function(|name| self.address_of(name)) }
    }

    fn address_of(&self, name: &str) -> *const c_void {
        CString::new(name).map_or(ptr::null(), |name| self.context.display().get_proc_address(&name))
    }
}

/// A window that is never shown and receives no input. It belongs to the thread that made it, as the context does.
struct HiddenWindow {
    window: HWND,
    handle: RawWindowHandle,
}

impl HiddenWindow {
    fn new() -> std::io::Result<Self> {
        let name = w!("gonio without a window");
        // SAFETY: the class has the system's own procedure and a static name; fields that are zero mean "none". If the class is
        // registered already, by another context, nothing happens. The window is created with that class and no parent.
        let (window, instance) = unsafe {
            let instance = GetModuleHandleW(ptr::null());
            let class = WNDCLASSW {
                style: CS_OWNDC,
                lpfnWndProc: Some(DefWindowProcW),
                hInstance: instance,
                lpszClassName: name,
                ..std::mem::zeroed()
            };
            RegisterClassW(&class);
            let none = ptr::null_mut();
            (CreateWindowExW(0, name, name, 0, 0, 0, 1, 1, none, none, instance, ptr::null()), instance)
        };
        let hwnd = NonZeroIsize::new(window as isize).ok_or_else(std::io::Error::last_os_error)?;
        let mut handle = Win32WindowHandle::new(hwnd);
        handle.hinstance = NonZeroIsize::new(instance as isize);
        Ok(HiddenWindow { window, handle: RawWindowHandle::Win32(handle) })
    }
}

impl Drop for HiddenWindow {
    fn drop(&mut self) {
        // SAFETY: `new` created the window on this thread: neither type can move to another one. It is destroyed once.
        unsafe { DestroyWindow(self.window) };
    }
}
