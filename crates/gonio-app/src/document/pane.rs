//! A pane: the scene and its camera, with settings of its own.

use gonio_language::{name, tr};
use gonio_light::brdf::BrdfKind;
use gonio_light::{Convention, Quantity, Simplification, Simplifications, Specular};
use gonio_render::{DisplayOptions, View};
use gonio_scene::detail::LevelOfDetail;
use gonio_scene::scene_file::Shading;
use gonio_scene::{Overlays, SceneSettings, SpecialView, ViewSpec, defaults};

/// The quantities on the number keys 1 to 9; 0 is the picture.
pub const VIEW_KEYS: [Quantity; 9] = [
    Quantity::Normal,
    Quantity::Light,
    Quantity::View,
    Quantity::Reflection,
    Quantity::Half,
    Quantity::Diffuse,
    Quantity::Specular,
    Quantity::Depth,
    Quantity::Uv,
];

/// An overlay of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaneOverlay {
    /// The edges of all triangles.
    Wireframe,
    /// The normals.
    Normals,
    /// The box around each object.
    Boxes,
}

/// Reflectance model of one pane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaneReflectance {
    /// The diffuse and the specular term.
    Terms,
    /// A BRDF of Appendix 6.
    Brdf(BrdfKind),
}

impl PaneReflectance {
    /// All models, the terms first.
    pub fn all() -> Vec<PaneReflectance> {
        let brdfs = BrdfKind::ALL.iter().map(|&kind| PaneReflectance::Brdf(kind));
        [PaneReflectance::Terms].into_iter().chain(brdfs).collect()
    }

    /// The name in the interface.
    pub fn name(self) -> &'static str {
        match self {
            PaneReflectance::Terms => "diff + spec",
            PaneReflectance::Brdf(kind) => kind.name(),
        }
    }
}

/// Settings of a pane that shows the traced picture: the rendering equation in place of the light equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TruthSettings {
    /// What is left out of the rendering equation.
    pub simplified: Simplifications,
    /// Points that replace a lamp where the integral is a sum, >= 1.
    pub points_per_light: u32,
}

impl Default for TruthSettings {
    fn default() -> Self {
        TruthSettings { simplified: Simplifications::NONE, points_per_light: 1 }
    }
}

/// Baked textures on the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BakedLook {
    /// The materials of the baked model.
    Materials,
    /// The picture that the atlas shows, without light.
    Picture,
}

/// Settings of one pane. `None` means: as in the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pane {
    /// The shading of all objects.
    pub shading: Option<Shading>,
    /// The specular term.
    pub specular: Option<Specular>,
    /// The lab's or the physical convention.
    pub convention: Option<Convention>,
    /// Whether the specular term is weighted by `<N.L>`. `None` follows the pane's own convention, if it has one.
    pub cosine_weighted: Option<bool>,
    /// A BRDF, or the terms.
    pub reflectance: Option<PaneReflectance>,
    /// Level of detail.
    pub detail: Option<LevelOfDetail>,
    /// A quantity of the equation in place of the picture.
    pub view: Option<ViewSpec>,
    /// A view that is not a quantity of the equation, in place of the picture and of `view`.
    pub special: Option<SpecialView>,
    /// The overlays.
    pub overlays: Overlays,
    /// The traced picture in place of OpenGL's, without view and overlays.
    pub truth: Option<TruthSettings>,
    /// The baked textures on the model, once there are any.
    pub baked: Option<BakedLook>,
}

impl Pane {
    /// Shows a quantity of the equation, or the picture.
    pub fn show_view(&mut self, view: Option<ViewSpec>) {
        (self.view, self.special, self.truth) = (view, None, None);
    }

    /// Shows a view that is not a quantity, or the picture.
    pub fn show_special(&mut self, view: Option<SpecialView>) {
        (self.special, self.truth) = (view, None);
    }

    /// Shows the traced picture, or OpenGL's.
    pub fn show_truth(&mut self, truth: Option<TruthSettings>) {
        (self.view, self.special, self.truth) = (None, None, truth);
        if truth.is_some() {
            // A worker that traces reads the scene's files again.
            self.baked = None;
        }
    }

    /// Shows the baked textures on the model, or the scene's own materials.
    pub fn show_baked(&mut self, look: Option<BakedLook>) {
        self.baked = look;
        if look.is_some() {
            self.truth = None;
        }
    }

    /// Shows or hides an overlay. Returns whether it can be seen: over a traced picture none is drawn, and none changes.
    pub fn toggle_overlay(&mut self, overlay: PaneOverlay) -> bool {
        if self.truth.is_some() {
            return false;
        }
        let on = match overlay {
            PaneOverlay::Wireframe => &mut self.overlays.wireframe,
            PaneOverlay::Normals => &mut self.overlays.normals,
            PaneOverlay::Boxes => &mut self.overlays.boxes,
        };
        *on = !*on;
        true
    }

    /// The view and the overlays, for the renderer.
    pub fn show(&self) -> DisplayOptions {
        if self.truth.is_some() {
            return DisplayOptions::default();
        }
        let view = self.special.map_or_else(|| self.view.into(), View::Special);
        DisplayOptions { view, overlays: self.overlays }
    }

    /// The scene with the pane's settings in place of its own, except the level of detail.
    pub fn applied_to(&self, scene: &SceneSettings) -> SceneSettings {
        let mut scene = scene.clone();
        if let Some(shading) = self.shading {
            scene.objects.iter_mut().for_each(|object| object.shading = shading);
        }
        let equation = &mut scene.equation;
        if let Some(specular) = self.specular {
            equation.specular = specular;
            // A BRDF of the scene would hide it.
            equation.brdf = None;
        }
        if let Some(convention) = self.convention {
            equation.convention = convention;
            equation.cosine_weighted = defaults::cosine_weighted(convention);
        }
        if let Some(weighted) = self.cosine_weighted {
            equation.cosine_weighted = weighted;
        }
        match self.reflectance {
            Some(PaneReflectance::Terms) => equation.brdf = None,
            Some(PaneReflectance::Brdf(kind)) => equation.brdf = Some(kind),
            None => {}
        }
        scene
    }

    /// The settings that differ from the scene, in words.
    pub fn words(&self) -> Vec<String> {
        let mut words: Vec<String> = Vec::new();
        words.extend(self.truth.map(|truth| traced(truth.simplified)));
        words.extend(self.baked.map(|look| match look {
            BakedLook::Materials => "baked".to_owned(),
            BakedLook::Picture => tr!("window-baked-picture").to_owned(),
        }));
        words.extend(self.shading.map(|s| written(name(s.name()))));
        words.extend(self.detail.map(detail_name));
        words.extend(self.specular.map(|s| match s {
            Specular::None => tr!("window-no-specular-term").into(),
            other => written(name(other.name())),
        }));
        words.extend(self.reflectance.map(|r| written(name(r.name()))));
        words.extend(self.convention.map(|c| name(c.name()).to_owned()));
        words.extend(self.cosine_weighted.map(|weighted| {
            if weighted { tr!("window-spec-times-n-l").to_owned() } else { tr!("window-spec-without-n-l").to_owned() }
        }));
        words.extend(self.special.map(|special| special.to_string()));
        let view = self.view.filter(|_| self.special.is_none());
        words.extend(view.map(|view| match view.light {
            Some(light) => tr!("window-of-light", quantity = view.quantity, light = light),
            None => view.quantity.to_string(),
        }));
        let overlays = if self.truth.is_some() { Overlays::default() } else { self.overlays };
        let names = [
            (overlays.wireframe, tr!("scene-wireframe")),
            (overlays.normals, tr!("scene-normals-overlay")),
            (overlays.boxes, tr!("scene-boxes")),
        ];
        words.extend(names.into_iter().filter(|(on, _)| *on).map(|(_, name)| name.to_owned()));
        words
    }

    /// [`Self::words`] as one caption.
    pub fn caption(&self) -> String {
        let words = self.words();
        if words.is_empty() { tr!("window-as-in-the-scene").to_owned() } else { words.join(" · ") }
    }
}

/// `traced`, and what is simplified.
fn traced(simplified: Simplifications) -> String {
    let names: Vec<&str> = simplified.iter().map(Simplification::name).collect();
    let last = simplified.iter().last();
    match names.as_slice() {
        [] => "traced".to_owned(),
        _ if simplified == Simplifications::ALL => tr!("window-traced-with-all-simplifications").to_owned(),
        // The lecture's order.
        [.., _] if last.is_some_and(|last| simplified == Simplifications::up_to(last)) => {
            tr!("window-traced-up-to-step", heading = last.map_or("", |last| last.heading().0))
        }
        [one] => tr!("window-traced-simplified", one = one),
        names => tr!("window-traced-simplifications", count = names.len()),
    }
}

/// A name as written in captions: names of people are capitalised.
fn written(name: &str) -> String {
    match name {
        "gouraud" => "Gouraud".into(),
        "phong" => "Phong".into(),
        "blinn-phong" => "Blinn-Phong".into(),
        "flat-per-face" => tr!("window-per-face").into(),
        "lambert" => "Lambert".into(),
        "lafortune" => "Lafortune".into(),
        "blinn" => "Blinn".into(),
        "ward" => "Ward".into(),
        other => other.into(),
    }
}

fn detail_name(detail: LevelOfDetail) -> String {
    match detail {
        LevelOfDetail::Share(share) => tr!("window-of-the-triangles", share = format!("{:.0}", 100.0 * share)),
        LevelOfDetail::Sphere(triangles) => tr!("window-triangles", triangles = triangles),
    }
}

/// Arrangement of several panes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PaneArrangement {
    /// All panes next to each other.
    #[default]
    SideBySide,
    /// The pair on top of each other; the first is visible left of this share of the width.
    Wipe(f32),
    /// Statistics of the difference of the pair.
    Difference,
}

/// Colouring of a difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DifferenceSettings {
    /// The 8-bit steps that get the scale's last colour, 1 to 255.
    pub full_scale: f64,
    /// The second minus the first, instead of the size alone.
    pub signed: bool,
}

impl Default for DifferenceSettings {
    fn default() -> Self {
        DifferenceSettings { full_scale: 64.0, signed: false }
    }
}

/// One to four panes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panes {
    /// At least one, at most [`Panes::MOST`].
    pub list: Vec<Pane>,
    /// Index of the pane that settings apply to.
    pub current: usize,
    /// Arrangement of the panes.
    pub arrangement: PaneArrangement,
    /// Indices of the two panes that are compared.
    pub pair: [usize; 2],
    /// Colouring of the difference.
    pub difference: DifferenceSettings,
}

impl Panes {
    /// Largest number of panes: more would be too small to compare.
    pub const MOST: usize = 4;

    /// The pane that settings apply to.
    pub fn current(&self) -> Option<&Pane> {
        self.list.get(self.current)
    }

    /// The pane that settings apply to, mutable.
    pub fn current_mut(&mut self) -> Option<&mut Pane> {
        self.list.get_mut(self.current)
    }

    /// Appends a copy of the current pane and makes it current, unless there are
    /// [`Self::MOST`].
    pub fn add(&mut self) {
        if self.list.len() < Self::MOST {
            self.list.push(self.current().cloned().unwrap_or_default());
            self.current = self.list.len() - 1;
            self.pair = [self.pair[0].min(self.current), self.current];
            if self.pair[0] == self.pair[1] {
                self.pair[0] = 0;
            }
        }
    }

    /// Removes a pane; the last one stays.
    pub fn remove(&mut self, index: usize) {
        if self.list.len() > 1 && index < self.list.len() {
            self.list.remove(index);
            let last = self.list.len() - 1;
            let after = |i: usize| if i > index { i - 1 } else { i.min(last) };
            let [first, second] = self.pair;
            self.current = after(self.current);
            self.pair = [after(first), after(second)];
            if self.pair[0] == self.pair[1] {
                self.pair = [0, last.min(1)];
            }
            if last == 0 {
                self.arrangement = PaneArrangement::SideBySide;
            }
        }
    }

    /// Replaces all panes, and makes the first current.
    pub fn set(&mut self, list: Vec<Pane>) {
        self.list = list;
        self.list.truncate(Self::MOST);
        if self.list.is_empty() {
            self.list.push(Pane::default());
        }
        (self.current, self.pair) = (0, [0, 1.min(self.list.len() - 1)]);
        if self.list.len() == 1 {
            self.arrangement = PaneArrangement::SideBySide;
        }
    }

    /// Whether a pane shows the widgets that are shown once: the first of several side by side, otherwise any.
    pub fn is_leading(&self, index: usize) -> bool {
        index == 0 || self.arrangement != PaneArrangement::SideBySide
    }

    /// The caption of a pane. Beside a traced picture, one without settings of its own is called OpenGL's.
    pub fn caption(&self, index: usize) -> String {
        let Some(pane) = self.list.get(index) else { return String::new() };
        let beside_traced = self.list.iter().any(|pane| pane.truth.is_some());
        if beside_traced && pane.words().is_empty() { "OpenGL".to_owned() } else { pane.caption() }
    }

    /// The visible panes: all of them, or the pair.
    pub fn seen(&self) -> Vec<usize> {
        match self.arrangement {
            PaneArrangement::SideBySide => (0..self.list.len()).collect(),
            PaneArrangement::Wipe(_) | PaneArrangement::Difference => self.pair.to_vec(),
        }
    }
}

impl Default for Panes {
    fn default() -> Self {
        Panes {
            list: vec![Pane::default()],
            current: 0,
            arrangement: PaneArrangement::SideBySide,
            pair: [0, 0],
            difference: DifferenceSettings::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_come_and_go_and_indices_hold() {
        let mut panes = Panes::default();
        panes.add();
        assert_eq!((panes.list.len(), panes.current, panes.pair), (2, 1, [0, 1]));
        panes.add();
        panes.add();
        panes.add();
        assert_eq!((panes.list.len(), panes.current), (4, 3));
        panes.pair = [1, 3];
        panes.remove(1);
        assert_eq!((panes.list.len(), panes.current, panes.pair), (3, 2, [1, 2]));
        panes.list[2].show_truth(Some(TruthSettings::default()));
        assert_eq!([0, 1, 2, 3].map(|index| panes.caption(index)), ["OpenGL", "OpenGL", "traced", ""]);
        panes.list[2].show_truth(None);
        assert_eq!(panes.caption(0), "as in the scene");
        panes.arrangement = PaneArrangement::Difference;
        panes.remove(0);
        panes.remove(0);
        panes.remove(0);
        assert_eq!((panes.list.len(), panes.current, panes.arrangement), (1, 0, PaneArrangement::SideBySide));
        assert!(panes.pair.iter().all(|i| *i < panes.list.len()));
    }

    #[test]
    fn a_pane_shows_the_traced_picture_or_a_view() {
        let mut pane = Pane::default();
        assert!(pane.toggle_overlay(PaneOverlay::Boxes));
        pane.show_view(Some(ViewSpec { quantity: Quantity::Normal, light: None }));
        pane.show_truth(Some(TruthSettings::default()));
        assert_eq!((pane.caption().as_str(), pane.show()), ("traced", DisplayOptions::default()));
        let before = pane.clone();
        assert!(!pane.toggle_overlay(PaneOverlay::Wireframe), "it would be drawn by OpenGL");
        assert_eq!(pane, before);
        let simplified = Simplifications::up_to(Simplification::Wavelengths);
        pane.truth = Some(TruthSettings { simplified, points_per_light: 1 });
        assert_eq!(pane.caption(), "traced up to step 2");
        let caption = |simplified| {
            Pane { truth: Some(TruthSettings { simplified, points_per_light: 1 }), ..Pane::default() }.caption()
        };
        assert_eq!(caption(Simplifications::up_to(Simplification::Shadows)), "traced up to step 5b");
        assert_eq!(caption(Simplifications::ALL), "traced with all simplifications");
        let shadows = Simplifications::NONE.with(Simplification::Shadows);
        assert_eq!(caption(shadows), "traced, simplified: shadows");
        assert_eq!(caption(shadows.with(Simplification::Sum)), "traced, 2 simplifications");
        pane.show_special(Some(SpecialView::Overdraw));
        assert_eq!((pane.truth, pane.show().view), (None, View::Special(SpecialView::Overdraw)));
    }

    #[test]
    fn settings_replace_those_of_the_scene() {
        let mut scene = SceneSettings::default();
        scene.objects.push(Default::default());
        scene.equation.brdf = Some(BrdfKind::Ward);
        assert_eq!(Pane::default().applied_to(&scene), scene);
        let pane = Pane {
            shading: Some(Shading::Gouraud),
            specular: Some(Specular::Phong),
            convention: Some(Convention::Physical),
            ..Pane::default()
        };
        let shown = pane.applied_to(&scene);
        assert_eq!(shown.objects[0].shading, Shading::Gouraud);
        let e = &shown.equation;
        assert_eq!(
            (e.specular, e.convention, e.cosine_weighted, e.brdf),
            (Specular::Phong, Convention::Physical, true, None)
        );
        assert_eq!(pane.caption(), "Gouraud · Phong · physical");
        let weighted = Pane { cosine_weighted: Some(false), ..pane };
        assert!(!weighted.applied_to(&scene).equation.cosine_weighted);
        let ward = Pane { reflectance: Some(PaneReflectance::Brdf(BrdfKind::Blinn)), ..Pane::default() };
        assert_eq!(ward.applied_to(&scene).equation.brdf, Some(BrdfKind::Blinn));
    }
}
