//! What the environment can be saved as.

use gonio_environment::Layout;
use gonio_environment::encode::{Container, EnvironmentFormat};
use gonio_language::tr;

/// An environment to save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EnvironmentProduct {
    /// The container.
    pub container: Container,
    /// The format of pictures; KTX2 has its own.
    pub format: EnvironmentFormat,
    /// Texels along an edge of a face; a panorama is four times as wide. `None`: as fine as the environment.
    pub size: Option<u32>,
    /// The layout of faces.
    pub layout: Layout,
    /// Whether six faces are one zip file.
    pub is_zip: bool,
}

impl EnvironmentProduct {
    /// Kebab-case, for widgets' ids.
    pub fn id(self) -> &'static str {
        match (self.container, self.is_zip) {
            (Container::Faces, true) => "environment-faces-zip",
            (Container::Faces, false) => "environment-faces",
            (Container::Cross, _) => "environment-cross",
            (Container::VerticalCross, _) => "environment-vertical-cross",
            (Container::Strip, _) => "environment-strip",
            (Container::VerticalStrip, _) => "environment-vertical-strip",
            (Container::Equirectangular, _) => "environment-panorama",
            (Container::Ktx2, _) => "environment-ktx2",
        }
    }

    /// The title of its button.
    pub fn title(self) -> &'static str {
        match (self.container, self.is_zip) {
            (Container::Faces, true) => tr!("environment-six-faces-zip"),
            (Container::Faces, false) => tr!("environment-six-faces"),
            (Container::Cross, _) => tr!("environment-cross"),
            (Container::VerticalCross, _) => tr!("environment-vertical-cross"),
            (Container::Strip, _) => tr!("environment-strip"),
            (Container::VerticalStrip, _) => tr!("environment-vertical-strip"),
            (Container::Equirectangular, _) => tr!("environment-panorama"),
            (Container::Ktx2, _) => "KTX2",
        }
    }

    /// The file name extension.
    pub fn extension(self) -> &'static str {
        match (self.container, self.is_zip) {
            (Container::Faces, true) => "zip",
            (Container::Ktx2, _) => "ktx2",
            _ => self.format.extension(),
        }
    }

    /// Follows the environment's name in the name of the file.
    pub fn suffix(self) -> &'static str {
        match self.container {
            Container::Faces if self.is_zip => "_faces",
            Container::Cross | Container::VerticalCross => "_cross",
            Container::Strip | Container::VerticalStrip => "_strip",
            Container::Equirectangular => "_panorama",
            Container::Faces | Container::Ktx2 => "",
        }
    }
}
