//! Textures, which the caller samples.

/// How a lookup chooses its level of detail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TextureDetail {
    /// The base level: there are no derivatives.
    Base,
    /// From the derivatives of the coordinates along x and y of the picture, plus a bias.
    Implicit {
        /// The derivatives along x.
        dx: [f32; 3],
        /// The derivatives along y.
        dy: [f32; 3],
        /// Added to the level.
        bias: f32,
    },
    /// This level.
    Level(f32),
}

/// A lookup for one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureLookup {
    /// The point.
    pub point: usize,
    /// The value of the sampler: the number that the caller gave to the uniform.
    pub sampler: u32,
    /// The number of coordinates: 2 for `sampler2D`, 3 for `samplerCube`.
    pub dims: u8,
    /// The coordinates, after division by the last one in `textureProj`; texels for `texelFetch`.
    pub coordinates: [f32; 4],
    /// The level of detail.
    pub detail: TextureDetail,
    /// Added to the coordinates, in texels.
    pub offset: [i32; 3],
    /// The depth that a shadow lookup compares with.
    pub compare: Option<f32>,
    /// Whether the coordinates are texels (`texelFetch`).
    pub is_fetch: bool,
    /// The component of the four texels that `textureGather` returns.
    pub gather: Option<u8>,
}

/// Samples textures for the interpreter.
pub trait TextureSource: Sync {
    /// Returns red, green, blue and alpha; for samplers of integers, integers. Shadow lookups return the result of the
    /// comparison in all four.
    fn look_up(&self, lookup: &TextureLookup) -> [f32; 4];

    /// Returns the width, height and depth of a level in texels.
    fn size(&self, sampler: u32, level: i32) -> [u32; 3];

    /// Returns the number of levels.
    fn levels(&self, sampler: u32) -> u32 {
        let _ = sampler;
        1
    }
}

/// No textures: every lookup is black and opaque, as that of an incomplete texture in OpenGL.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NoTexture;

impl TextureSource for NoTexture {
    fn look_up(&self, _lookup: &TextureLookup) -> [f32; 4] {
        [0.0, 0.0, 0.0, 1.0]
    }

    fn size(&self, _sampler: u32, _level: i32) -> [u32; 3] {
        [0; 3]
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::compile::compile;
    use crate::run::{PointValues, RunOptions, StageInputs, run};
    use gonio_glsl::Stage;

    fn compiled(stage: Stage, source: &str) -> crate::code::CompiledStage {
        let mut parsed = gonio_glsl::parse(source);
        let checked = gonio_glsl::check(&mut parsed, stage);
        compile(&parsed, &checked).unwrap()
    }

    /// Returns what it is asked for.
    struct Echo;

    impl TextureSource for Echo {
        fn look_up(&self, lookup: &TextureLookup) -> [f32; 4] {
            let [x, y, ..] = lookup.coordinates;
            let detail = match lookup.detail {
                TextureDetail::Base => -1.0,
                TextureDetail::Implicit { dx, dy, bias } => dx[0] * 100.0 + dy[1] * 10.0 + bias,
                TextureDetail::Level(level) => level,
            };
            [x + lookup.offset[0] as f32, y, detail, lookup.compare.unwrap_or(lookup.sampler as f32)]
        }

        fn size(&self, _sampler: u32, level: i32) -> [u32; 3] {
            [64 >> level, 32 >> level, 1]
        }
    }

    #[test]
    fn textures_are_asked_with_what_each_function_says() {
        let cases: [(&str, [f32; 4]); 12] = [
            ("r = texture(s, vec2(1.0, 2.0));", [1.0, 2.0, 0.0, 5.0]),
            ("r = texture(s, vec2(x, 2.0), 3.0);", [4.0, 2.0, 103.0, 5.0]),
            ("r = textureLod(s, vec2(1.0, 2.0), 4.0);", [1.0, 2.0, 4.0, 5.0]),
            ("r = textureProj(s, vec3(2.0, 4.0, 2.0));", [1.0, 2.0, 0.0, 5.0]),
            ("r = textureProj(s, vec4(2.0, 4.0, 9.0, 2.0));", [1.0, 2.0, 0.0, 5.0]),
            ("r = textureGrad(s, vec2(1.0, 2.0), vec2(0.5, 0.0), vec2(0.0, 0.25));", [1.0, 2.0, 52.5, 5.0]),
            ("r = textureOffset(s, vec2(1.0, 2.0), ivec2(7, 0));", [8.0, 2.0, 0.0, 5.0]),
            ("r = texelFetch(s, ivec2(3, 4), 2);", [3.0, 4.0, 2.0, 5.0]),
            ("r = vec4(textureSize(s, 1), 0, 0);", [32.0, 16.0, 0.0, 0.0]),
            ("r = vec4(texture(shadow, vec3(1.0, 2.0, 0.75)));", [1.0; 4]),
            ("r = texture(cube, vec3(1.0, 2.0, 3.0));", [1.0, 2.0, 0.0, 6.0]),
            ("r = texture(many[1], vec2(1.0));", [1.0, 1.0, 0.0, 8.0]),
        ];
        for (statement, expected) in cases {
            let head = "#version 330 core\nin float x;\nuniform sampler2D s;\nuniform samplerCube cube;\n\
                    uniform sampler2DShadow shadow;\nuniform sampler2D many[2];\nout vec4 r;\n";
            let stage = compiled(Stage::Fragment, &format!("{head}void main() {{ {statement} }}"));
            let mut inputs = StageInputs::new(&stage, 8);
            let x: Vec<f32> = (0..8).map(|point| point as f32).collect();
            inputs.set_named(&stage, "x", PointValues::each(&[&x]));
            for (name, numbers) in [("s", &[5][..]), ("cube", &[6]), ("many", &[7, 8])] {
                inputs.set_named(&stage, name, PointValues::ints(numbers));
            }
            let result = run(&stage, &inputs, &RunOptions { textures: &Echo, quads: true, ..RunOptions::default() });
            let found: [f32; 4] = std::array::from_fn(|component| result.outputs[0].float(component, 4));
            assert_eq!(found, expected, "{statement}");
        }
    }
}
