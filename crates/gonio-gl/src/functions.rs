//! The functions of a context as safe calls: those of the table here, those that touch memory in `memory.rs`.
#![allow(unsafe_code)]

use crate::call_table::call_table;
use glow::HasContext;
use std::cell::Cell;
use std::sync::Arc;

/// The functions of a context that is current on this thread.
pub struct Functions {
    pub(super) context: Arc<glow::Context>,
    /// An error of ours, for calls that were not passed on to OpenGL; `GL_NO_ERROR` where there is none.
    pending: Cell<u32>,
}

impl Functions {
    /// The functions of a current context.
    pub fn new(context: Arc<glow::Context>) -> Self {
        Functions { context, pending: Cell::new(glow::NO_ERROR) }
    }

    /// Whether the context is one of OpenGL ES.
    pub fn is_embedded(&self) -> bool {
        self.context.version().is_embedded
    }

    /// The context's version: major, minor.
    pub fn version(&self) -> (u32, u32) {
        let version = self.context.version();
        (version.major, version.minor)
    }

    /// Whether the context has labels and debug groups.
    #[inline]
    pub fn supports_debug(&self) -> bool {
        self.context.supports_debug()
    }

    /// Whether the context has an extension.
    pub fn supports(&self, extension: &str) -> bool {
        self.context.supported_extensions().contains(extension)
    }

    /// Raises an error as OpenGL does: the first one stays until it is fetched. Used for calls that would touch memory outside
    /// of their arguments, as in WebGL.
    #[cold]
    pub fn raise(&self, error: u32) {
        if self.pending.get() == glow::NO_ERROR {
            self.pending.set(error);
        }
    }

    /// Fetches and clears an error: ours first, then OpenGL's.
    #[inline]
    pub fn get_error(&self) -> u32 {
        match self.pending.replace(glow::NO_ERROR) {
            glow::NO_ERROR => self.get_own_error(),
            error => error,
        }
    }
}

macro_rules! define_functions {
    (
        tabled { $(fn $tabled:ident($($t:ident: $T:ty),* $(,)?) $(-> $TR:ty)? $(=> |$state:ident| $note:expr)?;)* }
        written_out { $(fn $written:ident($($w:ident: $W:ty),* $(,)?) $(-> $WR:ty)?;)* }
    ) => {
        define_functions! { $(fn $tabled($($t: $T),*) $(-> $TR)?;)* $(fn $written($($w: $W),*) $(-> $WR)?;)* }
    };
    ($(fn $name:ident($($argument:ident: $Type:ty),*) $(-> $Result:ty)?;)*) => {
        /// The plain calls.
        #[allow(clippy::too_many_arguments)] // OpenGL's own
        impl Functions {
            $(
                #[inline]
                pub fn $name(&self, $($argument: $Type),*) $(-> $Result)? {
                    // SAFETY: the head of `call_table.rs` says why for all of them: wrong arguments raise an error, and no
                    // memory but that of strings, slices and results is touched.
                    unsafe { self.context.$name($($argument),*) }
                }
            )*
        }
    };
}

call_table!(define_functions);
