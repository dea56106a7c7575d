//! What a scene promises: messages, round trips, framing, motion, textures.

#![allow(clippy::unwrap_used)]

mod bad_input;
mod camera;
mod detection;
mod edit;
mod environments;
mod framing;
mod from_models;
mod limits;
mod memory;
mod messages;
mod motion;
mod options;
mod picture;
mod round_trip;
mod sampling;
mod schema;
mod spheres;
mod textures;
