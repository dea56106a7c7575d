//! Windows and macOS: OpenGL needs a window there, so winit and glutin create a hidden one.
#![allow(unsafe_code)]

use super::HeadlessOptions;
use crate::GlError;
use glutin::config::ConfigTemplateBuilder;
use glutin::context::{ContextApi, ContextAttributesBuilder, GlProfile, PossiblyCurrentContext, Version};
use glutin::display::GetGlDisplay;
use glutin::prelude::*;
use glutin::surface::{Surface, SurfaceAttributesBuilder, WindowSurface};
use glutin_winit::DisplayBuilder;
use std::ffi::{CString, c_void};
use std::num::NonZeroU32;
use winit::event_loop::EventLoop;
use winit::raw_window_handle::HasWindowHandle;
use winit::window::{Window, WindowAttributes};

/// A current context on a hidden window.
pub struct HeadlessPlatform {
    context: PossiblyCurrentContext,
    _surface: Surface<WindowSurface>,
    _window: Window,
    _event_loop: EventLoop<()>,
}

impl HeadlessPlatform {
    pub fn new(options: &HeadlessOptions) -> Result<Self, GlError> {
        let failed =
            |problem: &str, error: &dyn std::fmt::Display| GlError::new(format!("no OpenGL: {problem} ({error})"));
        let event_loop = EventLoop::new().map_err(|e| failed("cannot connect to the desktop", &e))?;
        let attributes: WindowAttributes = Window::default_attributes().with_visible(false).with_title("gonio");
        let (window, config) = DisplayBuilder::new()
            .with_window_attributes(Some(attributes))
            .build(&event_loop, ConfigTemplateBuilder::new(), |mut configs| {
                // The builder's contract: the iterator is never empty.
                configs.next().expect("glutin offers at least one configuration")
            })
            .map_err(|e| failed("cannot create a hidden window", &e))?;
        let window = window.ok_or_else(|| GlError::new("no OpenGL: the desktop did not create a window"))?;
        let handle = window.window_handle().map_err(|e| failed("the window has no handle", &e))?.as_raw();
        let attributes = ContextAttributesBuilder::new()
            .with_profile(GlProfile::Core)
            .with_context_api(ContextApi::OpenGl(Some(Version::new(3, 3))))
            .with_debug(options.debug)
            .build(Some(handle));
        let display = config.display();
        // SAFETY: the handle belongs to `window`, which lives as long as the context does.
        let context = unsafe { display.create_context(&config, &attributes) }
            .map_err(|e| failed("the driver refused a context of OpenGL 3.3", &e))?;
        let surface_attributes =
            SurfaceAttributesBuilder::<WindowSurface>::new().build(handle, NonZeroU32::MIN, NonZeroU32::MIN);
        // SAFETY: as above.
        let surface = unsafe { display.create_window_surface(&config, &surface_attributes) }
            .map_err(|e| failed("the hidden window cannot be drawn to", &e))?;
        let context = context.make_current(&surface).map_err(|e| failed("the context cannot be made current", &e))?;
        Ok(HeadlessPlatform { context, _surface: surface, _window: window, _event_loop: event_loop })
    }

    /// The functions of the context, which is current.
    pub fn functions(&self) -> glow::Context {
        // SAFETY: `new` has made the context current on this thread, so these are that context's functions.
        unsafe { glow::Context::from_loader_function(|name| self.proc_address(name)) }
    }

    fn proc_address(&self, name: &str) -> *const c_void {
        CString::new(name).map_or(std::ptr::null(), |name| self.context.display().get_proc_address(&name))
    }
}
