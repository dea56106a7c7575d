//! A float target cut into tiles: many small pictures of one program, read back at once.

use gonio_gl::Dialect;
use gonio_gl::target::{Precision, Sampling, Target};
use gonio_gl::{Gl, GlError};

/// The value of a pixel that nothing was drawn to: no light is that negative.
pub const NOT_DRAWN: [f32; 4] = [-31_337.0; 4];

/// Square tiles side by side, each with a depth buffer; 32-bit floats, one sample a pixel.
pub struct TileTarget {
    gl: Gl,
    target: Target,
    side: i32,
    columns: i32,
    count: usize,
}

impl TileTarget {
    /// `count` tiles of `side` pixels. What does not fit the driver's largest texture is an error.
    pub fn new(gl: &Gl, side: u32, count: usize) -> Result<Self, GlError> {
        let columns = (count as f64).sqrt().ceil().max(1.0) as i32;
        let rows = (count as i32 + columns - 1) / columns;
        let size = [columns * side as i32, rows.max(1) * side as i32];
        let dialect = if gl.is_embedded() { Dialect::Es300 } else { Dialect::Core330 };
        let target = Target::new(gl, dialect, size, Sampling::Multi(1), Precision::Full)?;
        Ok(TileTarget { gl: gl.clone(), target, side: side as i32, columns, count })
    }

    /// Pixels along a tile's side.
    pub fn side(&self) -> usize {
        self.side as usize
    }

    /// Empties all tiles: [`NOT_DRAWN`], depth 1.
    pub fn begin(&self) {
        let gl = &self.gl;
        self.target.begin(gl, 0, self.target.size[1]);
        let [r, g, b, a] = NOT_DRAWN;
        gl.clear_color(r, g, b, a);
        gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        gl.disable(glow::BLEND);
        gl.disable(glow::CULL_FACE);
        gl.disable(glow::STENCIL_TEST);
        gl.enable(glow::DEPTH_TEST);
        // At the far plane too, as a skybox needs.
        gl.depth_func(glow::LEQUAL);
    }

    /// Later draws go into this tile alone. False where there is none of that number.
    pub fn select(&self, tile: usize) -> bool {
        if tile >= self.count {
            return false;
        }
        let (x, y) = (tile as i32 % self.columns * self.side, tile as i32 / self.columns * self.side);
        self.gl.viewport(x, y, self.side, self.side);
        self.gl.enable(glow::SCISSOR_TEST);
        self.gl.scissor(x, y, self.side, self.side);
        true
    }

    /// The first tiles one after the other, each `side * side` pixels, the bottom row first. Waits for the GPU.
    pub fn read(&self, count: usize) -> Vec<[f32; 4]> {
        self.gl.disable(glow::SCISSOR_TEST);
        let all = self.target.read_single(&self.gl);
        let (side, width) = (self.side as usize, self.target.size[0] as usize);
        let count = count.min(self.count);
        let mut tiles = Vec::with_capacity(count * side * side);
        for tile in 0..count {
            let (column, row) = (tile % self.columns as usize, tile / self.columns as usize);
            for y in 0..side {
                let first = ((row * side + y) * width + column * side) * 4;
                let line = all.get(first..first + side * 4).unwrap_or_default();
                tiles.extend(line.chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]));
            }
        }
        tiles
    }

    /// The error that OpenGL has raised since the last call, if any.
    pub fn error(&self) -> Option<GlError> {
        let code = self.gl.get_error();
        (code != glow::NO_ERROR).then(|| GlError::new(format!("OpenGL reported error {code:#06x} while drawing")))
    }
}
