//! The gonio window: one application for the desktop and the web page.
//!
//! [`App`] draws through `gonio-gl`, the renderer and the GLSL of `gonio render`, into textures that the window shows. In each
//! frame data flows one way: input, actions, document, pictures, window.
//!
//! | module | contents |
//! |---|---|
//! | `app` | the frame: events, actions, loading, saving |
//! | [`action`] | requests that are not a change of the document |
//! | [`shortcuts`] | keyboard shortcuts and their list |
//! | [`document`] | what is edited, saved and undone |
//! | [`session`] | everything else: loaded scene, time, selection, messages |
//! | [`panels`] | the equation, the lists, the numbers: widgets over the document |
//! | [`scene_view`] | the pictures of the scene, and what pointer and keys do there |
//! | `step` | shaders, stepped through at a pixel |
//! | [`baking`] | textures for new texture coordinates, and the atlas beside the model |
//! | [`environment`] | the environment's faces and panorama, their check, repair and conversion |
//! | [`mod@bench`] | the BRDF bench: functions plotted, compared and checked |
//! | [`gallery`] | the scenes of `gonio tour` with small pictures |
//! | [`stations`] | the stations beyond the rendering equation: pictures, sliders, laws |
//! | [`exercise`] | an exercise: the student's files, their picture, the checker |
//! | [`files`] | files that the user drops, chooses or links to |
//! | [`inspector`] | the content of the scene's model files, and the models in other formats |
//! | `beside` | work in steps beside the interface |
//! | `focus` | the ring around the focused control |
//! | [`mirror`] | the accessibility tree, for the page |
//! | [`saving`] | pictures and scenes as files |
//! | `missing_glyphs` | characters that no font can draw |
//! | [`platform`] | what desktop and web implement differently |
//! | [`truth`] | traced pictures: requests and answers |
//! | [`widgets`] | numbers, colours, choices |
//! | [`typeset`] | mathematical formulas |
//! | [`theme`] | fonts, colours, spacing |
//! | [`exported`] | the state as JSON |

pub mod action;
mod app;
pub mod baking;
pub mod bench;
mod beside;
pub mod document;
mod drafting;
pub mod environment;
pub mod exercise;
pub mod exported;
pub mod files;
mod focus;
pub mod gallery;
pub mod inspector;
pub mod mirror;
mod missing_glyphs;
pub mod panels;
pub mod platform;
pub mod saving;
pub mod scene_view;
pub mod session;
pub mod shortcuts;
pub mod stations;
mod step;
pub mod theme;
pub mod truth;
pub mod typeset;
pub mod widgets;

pub use app::loader::{Adjust, SceneOpening};
pub use app::{App, FIRST_SCENE};
