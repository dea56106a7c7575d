//! What a scene promises: messages, round trips, framing, motion, textures.

#![allow(clippy::unwrap_used)]

mod camera;
mod edit;
mod environments;
mod from_models;
mod limits;
mod memory;
mod messages;
mod round_trip;
mod spheres;
mod textures;
