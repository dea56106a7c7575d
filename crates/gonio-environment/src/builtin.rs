//! Environments that gonio brings along, by name.

use crate::convert::{Conversion, EnvironmentRef};
use crate::debug::debug;
use crate::face::Layout;
use crate::sky::Sky;
use crate::{Cubemap, EnvironmentError, Panorama};
use gonio_image::DecodeLimits;
use gonio_image::decode::{DecodedContent, decode};
use gonio_light::named_enum;

named_enum! {
    /// An environment that needs no file.
    pub enum Builtin {
        /// Each face its colour, its names written on it, arrows of the axes.
        Debug = "debug",
        /// A clear late-morning sky with its sun, over ground in the haze.
        Sky = "sky",
        /// A small furnished room (a panorama of 512 x 256, rendered for this project).
        Room = "room",
    }
    default Sky;
    what "built-in environment";
}

/// The room, Radiance HDR. Made for gonio with Blender, half of the original's size. A module for the web does not
/// carry it along: it would be a third of it, and the first picture does not want it.
#[cfg(not(target_arch = "wasm32"))]
const ROOM: Option<&[u8]> = Some(include_bytes!("../../../assets/environments/room.hdr"));
#[cfg(target_arch = "wasm32")]
const ROOM: Option<&[u8]> = None;

/// The path of the room's file below `assets`.
pub const ROOM_FILE: &str = "environments/room.hdr";

impl Builtin {
    /// The environment as a cubemap of `size` texels an edge (0 counts as 1). The debug cubemap has the file names of a
    /// layout written on it; the others do not depend on it.
    ///
    /// The room has 128 pixels per 90 degrees: larger sizes show no more detail. The only error is that the room's
    /// file, which is part of the program, cannot be read.
    pub fn cubemap(self, size: u32, layout: Layout) -> Result<Cubemap, EnvironmentError> {
        match self {
            Builtin::Debug => Ok(debug(size, layout)),
            Builtin::Sky => Ok(Sky::default().cubemap(size)),
            Builtin::Room => Ok(Conversion::default().cubemap(EnvironmentRef::Panorama(&room()?), size)),
        }
    }
}

/// The room as a panorama. On the web an error: there the room is a file of the page, for [`room_from`].
pub fn room() -> Result<Panorama, EnvironmentError> {
    let missing = || EnvironmentError::new("the room is still being downloaded; try again in a moment");
    room_from(ROOM.ok_or_else(missing)?)
}

/// The room as a panorama, from the bytes of [`ROOM_FILE`].
pub fn room_from(bytes: &[u8]) -> Result<Panorama, EnvironmentError> {
    let decoded = decode("room.hdr", bytes, &DecodeLimits::default())?;
    match decoded.shape {
        DecodedContent::Picture(image) => Panorama::new(image),
        DecodedContent::Faces(_) => Err(EnvironmentError::new("the built-in room is not a panorama")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn all_are_there_at_any_size() {
        for &kind in Builtin::ALL {
            for size in [0, 1, 20, 64] {
                let map = kind.cubemap(size, Layout::OpenGl).unwrap_or_else(|e| panic!("{kind}: {e}"));
                assert_eq!(map.size(), size.max(1));
                let finite = map.pixels().iter().flatten().all(|v| v.is_finite() && *v >= 0.0 && *v < 65504.0);
                assert!(finite && map.mean_radiance().min_element() > 0.05, "{kind} {size}: {}", map.mean_radiance());
            }
        }
    }

    #[test]
    fn the_room_is_upright_and_keeps_its_light() {
        let room = room().unwrap_or_else(|e| panic!("{e}"));
        assert_eq!((room.image.width, room.image.height), (512, 256));
        let mean = room.mean_radiance();
        for size in [1, 8, 128, 200] {
            let map = Builtin::Room.cubemap(size, Layout::OpenGl).unwrap_or_else(|e| panic!("{e}"));
            let error = (map.mean_radiance() / mean - 1.0).abs().max_element();
            // The area of a texel on its face stands for the solid angle under which it is seen: for the one texel of a
            // whole face that is not the same.
            assert!(error < if size == 1 { 0.05 } else { 0.01 }, "{size}: {} is not {mean}", map.mean_radiance());
            // As the panorama has it, not mirrored and not turned.
            if size == 200 {
                for d in [DVec3::new(1.0, 0.2, 0.3), DVec3::new(-0.4, -0.3, -1.0), DVec3::new(0.2, -1.0, 0.1)] {
                    let (got, expected) = (map.sample(d), room.sample(d));
                    assert!(got.abs_diff_eq(expected, 0.1 * expected.max_element()), "{d}: {got} is not {expected}");
                }
            }
        }
    }
}
