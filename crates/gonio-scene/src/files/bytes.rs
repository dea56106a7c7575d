//! The bytes of a file, wherever they lie.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// The bytes of a file: owned, mapped, shared or built in. Cloning shares them.
#[derive(Clone)]
pub struct FileBytes(Place);

#[derive(Clone)]
enum Place {
    Static(&'static [u8]),
    Shared(Arc<dyn AsRef<[u8]> + Send + Sync>),
}

impl FileBytes {
    /// Bytes of the program itself.
    pub fn from_static(bytes: &'static [u8]) -> Self {
        FileBytes(Place::Static(bytes))
    }

    /// Bytes of a memory map or of a shared buffer.
    pub fn shared(bytes: Arc<dyn AsRef<[u8]> + Send + Sync>) -> Self {
        FileBytes(Place::Shared(bytes))
    }

    /// A copy of one's own.
    pub fn into_vec(self) -> Vec<u8> {
        self.to_vec()
    }
}

/// Their number alone: a file may be large.
impl fmt::Debug for FileBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "FileBytes({})", self.len())
    }
}

impl From<Vec<u8>> for FileBytes {
    fn from(bytes: Vec<u8>) -> Self {
        FileBytes(Place::Shared(Arc::new(bytes)))
    }
}

impl Deref for FileBytes {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        match &self.0 {
            Place::Static(bytes) => bytes,
            Place::Shared(bytes) => (**bytes).as_ref(),
        }
    }
}
