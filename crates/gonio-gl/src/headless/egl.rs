//! EGL, loaded at run time: nothing is needed to build, and its absence is an ordinary error.
#![allow(unsafe_code)]

use super::HeadlessOptions;
use crate::GlError;
use khronos_egl as egl;
use std::ffi::{CStr, OsStr, c_char, c_void};

type Instance = egl::DynamicInstance<egl::EGL1_5>;

/// EGL_MESA_platform_surfaceless
const PLATFORM_SURFACELESS: egl::Enum = 0x31DD;
/// EGL_EXT_platform_device
const PLATFORM_DEVICE: egl::Enum = 0x313F;
/// The packages that bring EGL and Mesa's software driver to a Debian.
const PACKAGES: &str = "apt-get install libegl1 libgl1-mesa-dri";

/// A current context, destroyed when this is dropped. The display stays initialised: EGL has one for
/// the whole process, and terminating it would end the contexts of other threads.
pub struct Platform {
    egl: Instance,
    display: egl::Display,
    context: egl::Context,
}

impl Platform {
    pub fn new(options: &HeadlessOptions) -> Result<Self, GlError> {
        let egl = load(options)?;
        let display = open_display(&egl)?;
        let context = create_context(&egl, display, options)?;
        Ok(Platform { egl, display, context })
    }

    /// The functions of the context, which is current.
    pub fn functions(&self) -> glow::Context {
        // SAFETY: `new` has made the context current on this thread, so these are that context's functions.
        unsafe { glow::Context::from_loader_function(|name| self.proc_address(name)) }
    }

    fn proc_address(&self, name: &str) -> *const c_void {
        self.egl.get_proc_address(name).map_or(std::ptr::null(), |f| f as *const c_void)
    }
}

impl Drop for Platform {
    fn drop(&mut self) {
        // What cannot be given back at the end is the driver's to clean up.
        let _ = self.egl.make_current(self.display, None, None, None);
        let _ = self.egl.destroy_context(self.display, self.context);
    }
}

fn load(options: &HeadlessOptions) -> Result<Instance, GlError> {
    let name = options.egl_library.as_deref().map_or(OsStr::new("libEGL.so.1"), |p| p.as_os_str());
    // SAFETY: loading a library runs its initialisers; libEGL is made to be loaded this way.
    unsafe { Instance::load_required_from_filename(name) }.map_err(|error| {
        let why = match error {
            egl::LoadError::Library(_) => "could not be loaded",
            egl::LoadError::InvalidVersion { .. } => "is older than EGL 1.5",
        };
        GlError::new(format!("no OpenGL: {} {why}; on Debian: {PACKAGES}", name.to_string_lossy()))
    })
}

/// Hardware first where a device platform lists any; then Mesa's surfaceless platform, which needs no
/// device at all; then whatever device or default display there is.
fn open_display(egl: &Instance) -> Result<egl::Display, GlError> {
    let devices = devices(egl);
    let hardware = devices.iter().filter(|d| !d.software).map(|d| (PLATFORM_DEVICE, d.handle));
    let software = devices.iter().filter(|d| d.software).map(|d| (PLATFORM_DEVICE, d.handle));
    let surfaceless = std::iter::once((PLATFORM_SURFACELESS, std::ptr::null_mut()));
    let mut last_error = None;
    for (platform, native) in hardware.chain(surfaceless).chain(software) {
        // SAFETY: `native` is null for surfaceless and a device handle from EGL for devices, as the
        // platforms' specifications ask.
        match unsafe { egl.get_platform_display(platform, native, &[egl::ATTRIB_NONE]) } {
            Ok(display) => match egl.initialize(display) {
                Ok(_) => return Ok(display),
                Err(error) => last_error = Some(error),
            },
            Err(error) => last_error = Some(error),
        }
    }
    // SAFETY: the default display takes no pointer.
    if let Some(display) = unsafe { egl.get_display(egl::DEFAULT_DISPLAY) } {
        match egl.initialize(display) {
            Ok(_) => return Ok(display),
            Err(error) => last_error = Some(error),
        }
    }
    let why = match last_error {
        Some(egl::Error::NotInitialized) => "a driver was not found or did not start",
        Some(egl::Error::BadParameter) | None => "EGL knows no vendor's driver",
        Some(_) => "no display could be opened",
    };
    Err(GlError::new(format!("no OpenGL: {why}; on Debian: {PACKAGES}")))
}

struct Device {
    handle: *mut c_void,
    software: bool,
}

/// The devices of EGL_EXT_device_enumeration; none where the extension is missing.
fn devices(egl: &Instance) -> Vec<Device> {
    type QueryDevices = unsafe extern "system" fn(egl::Int, *mut *mut c_void, *mut egl::Int) -> egl::Boolean;
    type QueryDeviceString = unsafe extern "system" fn(*mut c_void, egl::Int) -> *const c_char;
    let (Some(query_devices), Some(query_string)) =
        (egl.get_proc_address("eglQueryDevicesEXT"), egl.get_proc_address("eglQueryDeviceStringEXT"))
    else {
        return Vec::new();
    };
    // SAFETY: these are the extension's functions, with the signatures of its specification. The
    // first call counts, the second fills an array of that length; strings are static, or null.
    unsafe {
        let query_devices: QueryDevices = std::mem::transmute(query_devices);
        let query_string: QueryDeviceString = std::mem::transmute(query_string);
        let mut count = 0;
        if query_devices(0, std::ptr::null_mut(), &mut count) != egl::TRUE || count <= 0 {
            return Vec::new();
        }
        let mut handles = vec![std::ptr::null_mut(); count as usize];
        if query_devices(count, handles.as_mut_ptr(), &mut count) != egl::TRUE {
            return Vec::new();
        }
        handles.truncate(count.max(0) as usize);
        handles
            .into_iter()
            .map(|handle| {
                let extensions = query_string(handle, egl::EXTENSIONS);
                let software = !extensions.is_null()
                    && CStr::from_ptr(extensions).to_string_lossy().contains("EGL_MESA_device_software");
                Device { handle, software }
            })
            .collect()
    }
}

fn create_context(egl: &Instance, display: egl::Display, options: &HeadlessOptions) -> Result<egl::Context, GlError> {
    let (api, name, renderable) = if options.es {
        (egl::OPENGL_ES_API, "OpenGL ES", egl::OPENGL_ES3_BIT)
    } else {
        (egl::OPENGL_API, "OpenGL", egl::OPENGL_BIT)
    };
    egl.bind_api(api).map_err(|_| GlError::new(format!("EGL does not offer {name}; on Debian: {PACKAGES}")))?;
    // No surface of any type is wanted: pictures are drawn into framebuffer objects.
    let config_attributes = [egl::SURFACE_TYPE, 0, egl::RENDERABLE_TYPE, renderable, egl::NONE];
    let config = egl
        .choose_first_config(display, &config_attributes)
        .ok()
        .flatten()
        .ok_or_else(|| GlError::new(format!("the driver has no configuration for {name} without a window")))?;
    let (major, minor) = if options.es { (3, 0) } else { (3, 3) };
    let mut attributes = vec![egl::CONTEXT_MAJOR_VERSION, major, egl::CONTEXT_MINOR_VERSION, minor];
    if !options.es {
        attributes.extend([egl::CONTEXT_OPENGL_PROFILE_MASK, egl::CONTEXT_OPENGL_CORE_PROFILE_BIT]);
    }
    if options.debug {
        attributes.extend([egl::CONTEXT_OPENGL_DEBUG, egl::TRUE as egl::Int]);
    }
    attributes.push(egl::NONE);
    let context = egl.create_context(display, config, None, &attributes).map_err(|_| {
        GlError::new(format!(
            "the driver is too old for gonio, which needs {name} {major}.{minor}; a newer driver (or Mesa's \
             software one) would do, and `--backend cpu` needs none"
        ))
    })?;
    if egl.make_current(display, None, None, Some(context)).is_err() {
        let _ = egl.destroy_context(display, context);
        return Err(GlError::new("the driver cannot draw without a window; `--backend cpu` needs none"));
    }
    Ok(context)
}
