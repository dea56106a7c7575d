//! The selection, and the tabs of the side panel.

/// The selected light, object or camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Selection {
    /// Nothing.
    #[default]
    None,
    /// A light of the scene, by its index.
    Light(usize),
    /// An object of the scene, by its index.
    Object(usize),
    /// The camera.
    Camera,
}

/// The tabs of the side panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    /// The lights: the rows of the sum.
    #[default]
    Lights,
    /// Objects and their materials.
    Objects,
    /// The camera and its matrices.
    Camera,
    /// Environment, background and display.
    Picture,
    /// The equation at a pixel.
    Probe,
    /// Panes side by side.
    Compare,
    /// The frame taken apart.
    Frame,
}

impl Tab {
    /// All tabs, in order.
    pub const ALL: [Tab; 7] =
        [Tab::Lights, Tab::Objects, Tab::Camera, Tab::Picture, Tab::Probe, Tab::Compare, Tab::Frame];

    /// The title.
    pub fn title(self) -> &'static str {
        match self {
            Tab::Lights => "Lights",
            Tab::Objects => "Objects",
            Tab::Camera => "Camera",
            Tab::Picture => "Picture",
            Tab::Probe => "Probe",
            Tab::Compare => "Compare",
            Tab::Frame => "Frame",
        }
    }

    /// A description in one sentence.
    pub fn description(self) -> &'static str {
        match self {
            Tab::Lights => "Lights: each adds one summand to the equation",
            Tab::Objects => "Models, their transformations and materials",
            Tab::Camera => "Camera parameters and matrices",
            Tab::Picture => "Environment, background, exposure and tone mapping",
            Tab::Probe => "The light equation at one pixel, in numbers",
            Tab::Compare => "The scene with up to four settings side by side",
            Tab::Frame => "The OpenGL calls that drew this picture",
        }
    }
}
