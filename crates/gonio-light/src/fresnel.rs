//! How much of the light is reflected where two media meet.
