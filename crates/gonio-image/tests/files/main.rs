//! Files of every format that is read or written, compared with other writers and readers.

mod cubemap_files;
mod damaged;
mod exr;
mod hdr;
mod pictures;
mod samples;
