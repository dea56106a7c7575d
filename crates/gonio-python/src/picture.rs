//! A picture: its linear pixels, and how they are shown.

use crate::array::{NativeArray, Numbers};
use crate::error::{Failure, bug, without_lock};
use gonio_image::EncodedPicture;
use gonio_image::encode::exr::{self, Layer};
use gonio_image::encode::png::{self, ColorTag};
use gonio_light::color::ColorEncoding;
use gonio_scene::{DisplayMap, Picture};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// A picture, or a view of one quantity.
#[pyclass(frozen, module = "gonio._native")]
pub struct NativePicture {
    pixels: Py<NativeArray>,
    size: [u32; 2],
    map: DisplayMap,
}

impl NativePicture {
    /// The picture as an object of Python, with the map from its numbers to displayed ones.
    pub fn new(py: Python<'_>, picture: Picture, map: DisplayMap) -> PyResult<Self> {
        let size = [picture.width, picture.height];
        let array = new_array(py, Numbers::Pixels(picture.pixels), size)?;
        Ok(NativePicture { pixels: array, size, map })
    }

    fn encoded(&self) -> EncodedPicture<u8> {
        let [width, height] = self.size;
        // A picture owns its pixels, so they are copied: a tenth of the time that encoding them takes.
        Picture { width, height, pixels: self.pixels.get().pixels().to_vec() }.encode8(&self.map)
    }

    fn tag(&self) -> ColorTag {
        match self.map {
            DisplayMap::Light(transform) if transform.encoding == ColorEncoding::Srgb => ColorTag::Srgb,
            _ => ColorTag::Untagged,
        }
    }
}

/// An array of `size` pixels of four numbers.
fn new_array(py: Python<'_>, numbers: Numbers, [width, height]: [u32; 2]) -> PyResult<Py<NativeArray>> {
    match NativeArray::new(numbers, [height as usize, width as usize, 4]) {
        Some(array) => Py::new(py, array),
        None => Err(bug(&"a picture has other pixels than its size says")),
    }
}

#[pymethods]
impl NativePicture {
    /// Linear RGBA, premultiplied: float32 of (height, width, 4).
    fn linear(&self, py: Python<'_>) -> Py<NativeArray> {
        self.pixels.clone_ref(py)
    }

    /// The displayed values: uint8 of (height, width, 4).
    fn displayed(&self, py: Python<'_>) -> PyResult<Py<NativeArray>> {
        let encoded = without_lock(py, || Ok(self.encoded()))?;
        new_array(py, Numbers::Bytes(encoded.rgba), self.size)
    }

    /// The displayed values as a PNG file.
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = without_lock(py, || Ok(png::encode8(&self.encoded(), self.tag())?))?;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// DrawnPictures of one size as the layers of an OpenEXR file: pairs of a name and a picture.
#[pyfunction]
pub fn encode_exr<'py>(py: Python<'py>, layers: Vec<(String, Py<NativePicture>)>) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = without_lock(py, || {
        let size = layers.first().map_or([0, 0], |(_, first)| first.get().size);
        if layers.iter().any(|(_, picture)| picture.get().size != size) {
            return Err(Failure::new("the layers of an OpenEXR file have one size"));
        }
        let layers: Vec<Layer<'_>> =
            layers.iter().map(|(name, picture)| Layer { name, pixels: picture.get().pixels.get().pixels() }).collect();
        Ok(exr::encode_layers(size, &layers)?)
    })?;
    Ok(PyBytes::new(py, &bytes))
}
