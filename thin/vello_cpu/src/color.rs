//! The one colour that there is.

use std::marker::PhantomData;

/// The colour space of screens.
#[derive(Clone, Copy, Debug)]
pub struct Srgb;

/// A colour that hides what is behind it: white.
#[derive(Clone, Copy, Debug)]
pub struct OpaqueColor<Space>(PhantomData<Space>);

impl<Space> OpaqueColor<Space> {
    /// White.
    pub const WHITE: Self = OpaqueColor(PhantomData);
}
