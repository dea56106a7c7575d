//! Limits on the size of a picture, checked before anything is allocated for it.

pub use gonio_scene::validate::{MAX_PIXELS, MAX_SIDE};

/// Checks the size of a picture. The error names the largest size.
pub fn check_size(width: u64, height: u64) -> Result<(), String> {
    if width == 0 || height == 0 {
        return Err(format!("a picture of {width}x{height} has no pixels: both sides must be at least 1"));
    }
    let side = u64::from(MAX_SIDE);
    if width > side || height > side || width * height > MAX_PIXELS {
        return Err(format!(
            "{width}x{height} is too large: a picture has at most {MAX_SIDE} pixels along a side and {MAX_PIXELS} \
             altogether, for example 8192x8192"
        ));
    }
    Ok(())
}

/// Most frames of an animation: as many as four digits can number.
pub const MAX_FRAMES: u32 = 9999;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_at_the_edges() {
        assert!(check_size(1, 1).is_ok());
        assert!(check_size(8192, 8192).is_ok());
        assert!(check_size(16384, 4096).is_ok());
        assert!(check_size(0, 10).is_err());
        assert!(check_size(8193, 8192).is_err());
        assert!(check_size(16385, 1).is_err());
        assert!(check_size(u64::from(u32::MAX), u64::from(u32::MAX)).is_err());
        assert!(check_size(100_000, 100_000).is_err_and(|e| e.contains("16384")));
    }
}
