//! Image files: bytes in, images out, and back. No function here opens a file.
//!
//! | module | contents |
//! |---|---|
//! | [`image`] | an image in linear light, and one in the numbers of a file; the error type; how much memory a file may use |
//! | [`mod@decode`] | PNG, JPEG, Radiance HDR, OpenEXR, KTX2 and DDS to linear light |
//! | [`encode`] | linear light and encoded pictures to PNG, animated PNG, Radiance HDR, OpenEXR and KTX2 |
//! | [`mod@flip`] | how different two pictures look |
//! | [`srgb`] | the sRGB transfer function by table |

pub mod decode;
pub mod encode;
pub mod flip;
pub mod image;
pub mod srgb;

pub use image::{DecodeLimits, EncodedPicture, Image, ImageError, Pixel};
