//! The shaders that show a finished picture.

use gonio_gl::Dialect;

/// Vertex and fragment shader: a triangle over the whole viewport, the texture's first row at the top.
pub fn presentation_sources(dialect: Dialect) -> [String; 2] {
    let header = dialect.header();
    let vertex = "out vec2 place;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    place = vec2(corner.x, 1.0 - corner.y);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
";
    let fragment = "uniform sampler2D picture;
in vec2 place;
out vec4 frag_color;
void main() {
    frag_color = texture(picture, place);
}
";
    [format!("{header}{vertex}"), format!("{header}{fragment}")]
}
