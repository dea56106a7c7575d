//! Files of every kind that is read or written, held against other people's writers and readers.

mod cubemap_files;
mod damaged;
mod exr;
mod hdr;
mod pictures;
mod samples;
