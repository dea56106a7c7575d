//! The only colour: white.

use std::marker::PhantomData;

/// The colour space of screens.
#[derive(Clone, Copy, Debug)]
pub struct Srgb;

/// An opaque colour: white.
#[derive(Clone, Copy, Debug)]
pub struct OpaqueColor<Space>(PhantomData<Space>);

impl<Space> OpaqueColor<Space> {
    /// White.
    pub const WHITE: Self = OpaqueColor(PhantomData);
}
