//! Files of every kind that is read or written, held against other people's writers and readers.

mod damaged;
mod dds;
mod exr;
mod hdr;
mod ktx2;
mod pictures;
mod samples;
