//! Image files: bytes in, images out, and back. No function here opens a file.
//!
//! | module | contents |
//! |---|---|
//! | [`image`] | an image in linear light, and one in the numbers of a file |
//! | [`mod@decode`] | PNG, JPEG, Radiance HDR, OpenEXR, KTX2 and DDS to linear light |
//! | [`encode`] | linear light and encoded pictures to PNG, animated PNG, Radiance HDR, OpenEXR and KTX2 |
//! | [`srgb`] | the sRGB transfer function by table |
//! | [`limits`] | how much memory a file may use |
//! | [`error`] | the error type |

pub mod decode;
pub mod encode;
pub mod error;
pub mod image;
pub mod limits;
pub mod srgb;

pub use error::ImageError;
pub use image::{EncodedPicture, Image, Pixel};
pub use limits::Limits;
