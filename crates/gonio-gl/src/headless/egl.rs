//! EGL, loaded at run time: nothing is needed to build, and its absence is an ordinary error.
#![allow(unsafe_code)]

use super::HeadlessOptions;
use crate::{GlError, Remedy};
use glutin_egl_sys::egl::{self, types};
use libloading::Library;
use std::ffi::{CStr, CString, OsStr, c_void};
use std::mem::ManuallyDrop;
use std::ptr;

/// EGL_MESA_platform_surfaceless
const PLATFORM_SURFACELESS: types::EGLenum = 0x31DD;
/// The packages that bring EGL and Mesa's software driver to a Debian.
const PACKAGES: &str = "apt-get install libegl1 libgl1-mesa-dri";

/// EGL's functions, and the library that they are in.
struct Egl {
    functions: egl::Egl,
    /// Never unloaded: EGL and the driver have destructors that run when a thread ends, long after its last context is gone.
    library: ManuallyDrop<Library>,
}

/// A current context, destroyed when this is dropped. The display stays initialised: EGL has one for
/// the whole process, and terminating it would end the contexts of other threads.
pub struct HeadlessPlatform {
    egl: Egl,
    display: types::EGLDisplay,
    context: types::EGLContext,
}

impl HeadlessPlatform {
    pub fn new(options: &HeadlessOptions) -> Result<Self, GlError> {
        let egl = Egl::load(options)?;
        let display = open_display(&egl)?;
        let context = create_context(&egl, display, options)?;
        Ok(HeadlessPlatform { egl, display, context })
    }

    /// The functions of the context, which is current.
    pub fn functions(&self) -> glow::Context {
        // SAFETY: `new` has made the context current on this thread, so these are that context's functions.
        unsafe { glow::Context::from_loader_function(|name| self.egl.address_of(name)) }
    }
}

impl Drop for HeadlessPlatform {
    fn drop(&mut self) {
        let egl = &self.egl.functions;
        // SAFETY: the context is this display's, and is destroyed once. What cannot be given back at the end is the
        // driver's to clean up.
        unsafe {
            egl.MakeCurrent(self.display, egl::NO_SURFACE, egl::NO_SURFACE, egl::NO_CONTEXT);
            egl.DestroyContext(self.display, self.context);
        }
    }
}

impl Egl {
    fn load(options: &HeadlessOptions) -> Result<Self, GlError> {
        let name = options.egl_library.as_deref().map_or(OsStr::new("libEGL.so.1"), |p| p.as_os_str());
        let failed = |why| GlError::new(format!("no OpenGL: {} {why}; on Debian: {PACKAGES}", name.to_string_lossy()));
        // SAFETY: loading a library runs its initialisers; libEGL is made to be loaded this way.
        let library = unsafe { Library::new(name) }.map_err(|_| failed("could not be loaded"))?;
        let library = ManuallyDrop::new(library);
        // The library has the functions of EGL itself; those of extensions come from `eglGetProcAddress`.
        let core = egl::Egl::load_with(|name| symbol(&library, name));
        if !core.GetPlatformDisplay.is_loaded() || !core.GetProcAddress.is_loaded() {
            return Err(failed("is older than EGL 1.5"));
        }
        let core = Egl { functions: core, library };
        let functions = egl::Egl::load_with(|name| match symbol(&core.library, name) {
            address if address.is_null() => core.address_of(name),
            address => address,
        });
        Ok(Egl { functions, library: core.library })
    }

    /// A function of EGL or OpenGL; null where there is none of that name.
    fn address_of(&self, name: &str) -> *const c_void {
        let Ok(name) = CString::new(name) else { return ptr::null() };
        // SAFETY: the name is a C string, and EGL 1.5 answers for every name.
        unsafe { self.functions.GetProcAddress(name.as_ptr()).cast() }
    }

    fn succeeds(&self, result: types::EGLBoolean) -> Result<(), types::EGLenum> {
        if result == egl::TRUE { Ok(()) } else { Err(self.error()) }
    }

    fn error(&self) -> types::EGLenum {
        // SAFETY: reads and clears this thread's error.
        unsafe { self.functions.GetError() as types::EGLenum }
    }

    /// An initialised display of a platform.
    fn platform_display(
        &self,
        platform: types::EGLenum,
        native: *const c_void,
    ) -> Result<types::EGLDisplay, types::EGLenum> {
        let attributes = [egl::NONE as types::EGLAttrib];
        // SAFETY: `native` is null for surfaceless and a device of EGL's for devices, as the platforms' specifications ask;
        // the attributes end with EGL_NONE.
        self.initialized(unsafe { self.functions.GetPlatformDisplay(platform, native.cast_mut(), attributes.as_ptr()) })
    }

    /// An initialised default display.
    fn default_display(&self) -> Result<types::EGLDisplay, types::EGLenum> {
        // SAFETY: the default display takes no pointer.
        self.initialized(unsafe { self.functions.GetDisplay(egl::DEFAULT_DISPLAY) })
    }

    fn initialized(&self, display: types::EGLDisplay) -> Result<types::EGLDisplay, types::EGLenum> {
        if display == egl::NO_DISPLAY {
            return Err(self.error());
        }
        // SAFETY: EGL checks the display; where the versions go may be null.
        self.succeeds(unsafe { self.functions.Initialize(display, ptr::null_mut(), ptr::null_mut()) })?;
        Ok(display)
    }

    /// The devices of EGL_EXT_device_enumeration; none where the extension is missing.
    fn devices(&self) -> Vec<Device> {
        let egl = &self.functions;
        if !egl.QueryDevicesEXT.is_loaded() || !egl.QueryDeviceStringEXT.is_loaded() {
            return Vec::new();
        }
        let mut count = 0;
        // SAFETY: without an array, the devices are only counted.
        if unsafe { egl.QueryDevicesEXT(0, ptr::null_mut(), &mut count) } != egl::TRUE || count <= 0 {
            return Vec::new();
        }
        let mut handles = vec![ptr::null(); count as usize];
        // SAFETY: EGL writes at most `count` devices, and there is room for as many.
        if unsafe { egl.QueryDevicesEXT(count, handles.as_mut_ptr(), &mut count) } != egl::TRUE {
            return Vec::new();
        }
        handles.truncate(count.max(0) as usize);
        let is_software = |handle: types::EGLDeviceEXT| {
            // SAFETY: the device is EGL's; the answer is null or a static C string.
            let extensions = unsafe {
                let extensions = egl.QueryDeviceStringEXT(handle, egl::EXTENSIONS as types::EGLint);
                (!extensions.is_null()).then(|| CStr::from_ptr(extensions))
            };
            extensions.is_some_and(|extensions| extensions.to_string_lossy().contains("EGL_MESA_device_software"))
        };
        handles.into_iter().map(|handle| Device { handle, software: is_software(handle) }).collect()
    }

    /// The first configuration with these attributes.
    fn config(&self, display: types::EGLDisplay, attributes: &[types::EGLenum]) -> Option<types::EGLConfig> {
        let attributes = ended(attributes);
        let (mut config, mut count) = (ptr::null(), 0);
        // SAFETY: the attributes end with EGL_NONE, and there is room for one configuration.
        let found = unsafe { self.functions.ChooseConfig(display, attributes.as_ptr(), &mut config, 1, &mut count) };
        (found == egl::TRUE && count > 0).then_some(config)
    }

    fn create_context(
        &self,
        display: types::EGLDisplay,
        config: types::EGLConfig,
        attributes: &[types::EGLenum],
    ) -> Option<types::EGLContext> {
        let attributes = ended(attributes);
        // SAFETY: the configuration is this display's, and the attributes end with EGL_NONE.
        let context = unsafe { self.functions.CreateContext(display, config, egl::NO_CONTEXT, attributes.as_ptr()) };
        (context != egl::NO_CONTEXT).then_some(context)
    }

    /// Makes a context current without any surface; destroys it where that fails.
    fn make_current(&self, display: types::EGLDisplay, context: types::EGLContext) -> bool {
        let egl = &self.functions;
        // SAFETY: the context is this display's, and no other code has it yet.
        unsafe {
            let made = egl.MakeCurrent(display, egl::NO_SURFACE, egl::NO_SURFACE, context) == egl::TRUE;
            if !made {
                egl.DestroyContext(display, context);
            }
            made
        }
    }
}

/// The address of a library's function; null where it has none of that name.
fn symbol(library: &Library, name: &str) -> *const c_void {
    // SAFETY: only the address is taken; the caller knows its type.
    unsafe { library.get::<*const c_void>(name.as_bytes()) }.map_or(ptr::null(), |symbol| *symbol)
}

/// A list of attributes with its end.
fn ended(attributes: &[types::EGLenum]) -> Vec<types::EGLint> {
    attributes.iter().chain([&egl::NONE]).map(|&attribute| attribute as types::EGLint).collect()
}

struct Device {
    handle: types::EGLDeviceEXT,
    software: bool,
}

/// Hardware first where a device platform lists any; then Mesa's surfaceless platform, which needs no
/// device at all; then whatever device or default display there is.
fn open_display(egl: &Egl) -> Result<types::EGLDisplay, GlError> {
    let devices = egl.devices();
    let hardware = devices.iter().filter(|d| !d.software).map(|d| (egl::PLATFORM_DEVICE_EXT, d.handle));
    let software = devices.iter().filter(|d| d.software).map(|d| (egl::PLATFORM_DEVICE_EXT, d.handle));
    let surfaceless = std::iter::once((PLATFORM_SURFACELESS, ptr::null()));
    let mut last_error = egl::BAD_PARAMETER;
    for (platform, native) in hardware.chain(surfaceless).chain(software) {
        match egl.platform_display(platform, native) {
            Ok(display) => return Ok(display),
            Err(error) => last_error = error,
        }
    }
    match egl.default_display() {
        Ok(display) => return Ok(display),
        Err(error) if error != egl::SUCCESS => last_error = error,
        Err(_) => {}
    }
    let reason = match last_error {
        egl::NOT_INITIALIZED => "a driver was not found or did not start",
        egl::BAD_PARAMETER => "EGL did not find the driver of any vendor",
        _ => "no display could be opened",
    };
    Err(GlError::new(format!("no OpenGL: {reason}; on Debian: {PACKAGES}")))
}

fn create_context(
    egl: &Egl,
    display: types::EGLDisplay,
    options: &HeadlessOptions,
) -> Result<types::EGLContext, GlError> {
    let (api, name, renderable) = if options.es {
        (egl::OPENGL_ES_API, "OpenGL ES", egl::OPENGL_ES3_BIT)
    } else {
        (egl::OPENGL_API, "OpenGL", egl::OPENGL_BIT)
    };
    // SAFETY: EGL checks the name of the interface.
    egl.succeeds(unsafe { egl.functions.BindAPI(api) })
        .map_err(|_| GlError::new(format!("EGL does not offer {name}; on Debian: {PACKAGES}")))?;
    // A surface of no type is needed: pictures are drawn into framebuffer objects.
    let config = egl
        .config(display, &[egl::SURFACE_TYPE, 0, egl::RENDERABLE_TYPE, renderable])
        .ok_or_else(|| GlError::new(format!("the driver has no configuration for {name} without a window")))?;
    let (major, minor) = if options.es { (3, 0) } else { (3, 3) };
    let mut attributes = vec![egl::CONTEXT_MAJOR_VERSION, major, egl::CONTEXT_MINOR_VERSION, minor];
    if !options.es {
        attributes.extend([egl::CONTEXT_OPENGL_PROFILE_MASK, egl::CONTEXT_OPENGL_CORE_PROFILE_BIT]);
    }
    if options.debug {
        attributes.extend([egl::CONTEXT_OPENGL_DEBUG, egl::TRUE]);
    }
    let context = egl.create_context(display, config, &attributes).ok_or_else(|| {
        GlError::new(format!(
            "the driver is too old: gonio needs {name} {major}.{minor}; install a newer driver, or Mesa's software driver"
        ))
        .with_remedy(Remedy::CpuRenderer)
    })?;
    if !egl.make_current(display, context) {
        return Err(GlError::new("the driver cannot draw without a window").with_remedy(Remedy::CpuRenderer));
    }
    Ok(context)
}
