//! The part of a probe's page about the environment.

use super::text::{ProbePage, short};
use gonio_light::optics::boundary;
use gonio_light::{Fresnel, Surfaces};
use gonio_reference::Probe;

impl ProbePage<'_> {
    /// The light of the environment, and the sum with it; nothing if the frame has none.
    pub(super) fn surroundings(&mut self, probe: &Probe) {
        let (Some(environment), Some(how)) = (&self.scene.environment, self.frame.surroundings) else { return };
        let lights = if how.lights { "it lights the objects" } else { "it does not light the objects" };
        let name = format!("environment `{}`, intensity {}, {lights}", environment.name, short(how.intensity));
        self.heading(&name);
        if probe.optics.is_plain() {
            self.line("optics", "the material neither reflects nor transmits");
            if !how.lights {
                return;
            }
        } else {
            self.optics(probe);
            self.sight(probe);
        }
        let seen = &probe.terms.environment;
        if how.lights {
            self.vector("diffuse", seen.diffuse, "= k_d * light of the environment around N");
            self.vector("specular", seen.specular, "= (k_s * scale + bias) * its glossy reflection");
        }
        self.vector("L", probe.radiance, "");
        self.composed(probe);
    }

    /// The optics of the material.
    fn optics(&mut self, probe: &Probe) {
        let optics = &probe.optics;
        self.scalar("reflectivity", optics.reflectivity, "");
        self.scalar("transmission", optics.transmission, "t");
        let fresnel = match optics.fresnel {
            Fresnel::None => "none: independent of the angle",
            Fresnel::Exact => "exact, unpolarised",
            Fresnel::Schlick => "Schlick's approximation",
        };
        self.line("Fresnel", fresnel);
        if optics.transmission > 0.0 {
            let surfaces = match optics.surfaces {
                Surfaces::One => "one: where the view enters",
                Surfaces::Two => "two: where the view enters and where it leaves",
            };
            self.line("surfaces", surfaces);
            self.vector("tint", optics.tint, "");
            if optics.surfaces == Surfaces::Two {
                self.vector("absorption", optics.absorption, "per world unit");
            }
            if optics.dispersion != 0.0 {
                let indices = optics.indices(probe.surface.refraction_index);
                self.line("indices", &indices.map(|n| format!("{:>11}", short(n))).concat());
            }
        }
    }

    /// The reflected and the refracted view, and the light from there.
    fn sight(&mut self, probe: &Probe) {
        let (point, optics) = (&probe.terms.point, &probe.optics);
        let sight = &probe.terms.environment.sight;
        self.vector("R", sight.reflection, "V reflected about N");
        match boundary(point.normal, point.view, probe.surface.refraction_index, optics.fresnel).transmitted {
            Some(t) => self.vector("T", t, "V refracted"),
            None => self.line("T", "none: total internal reflection"),
        }
        self.vector("F", sight.fresnel, "of red, green and blue");
        self.vector("E(R)", sight.reflected, "");
        self.vector("(1-F) * tint * E(T)", sight.transmitted, "");
        let factor = if optics.fresnel == Fresnel::None { "= reflectivity" } else { "= reflectivity * F of green" };
        self.scalar("w", optics.mirror_share(sight.fresnel.y), factor);
    }

    /// The sum in symbols, and in numbers for each channel.
    fn composed(&mut self, probe: &Probe) {
        let seen = &probe.terms.environment;
        let lights = self.frame.surroundings.is_some_and(|s| s.lights);
        let lit = if lights { "(L_o + diffuse + specular)" } else { "L_o" };
        let plain = probe.optics.is_plain();
        let symbols = if plain {
            lit.trim_matches(['(', ')']).to_owned()
        } else {
            format!("(1-t) * [ (1-w) * {lit} + w * E(R) ] + t * [ F * E(R) + (1-F) * tint * E(T) ]")
        };
        self.text.blank();
        self.text.line(format_args!("  L = {symbols}"));
        let (w, t) = (probe.optics.mirror_share(seen.sight.fresnel.y), probe.optics.transmission);
        for (c, channel) in ["red", "green", "blue"].into_iter().enumerate() {
            let terms = [probe.lit[c], seen.diffuse[c], seen.specular[c]].map(short);
            let lit = if lights { terms.join(" + ") } else { terms[0].clone() };
            let sum = if plain {
                lit
            } else {
                let lit = if lights { format!("({lit})") } else { lit };
                let [f, reflected, transmitted] =
                    [seen.sight.fresnel[c], seen.sight.reflected[c], seen.sight.transmitted[c]].map(short);
                format!(
                    "{} * [ {} * {lit} + {} * {reflected} ] + {} * [ {f} * {reflected} + {transmitted} ]",
                    short(1.0 - t),
                    short(1.0 - w),
                    short(w),
                    short(t)
                )
            };
            self.text.line(format_args!("  {channel:6}{:>9} = {sum}", short(probe.radiance[c])));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::text::ProbePage;
    use glam::{DMat4, DVec3};
    use gonio_environment::Cubemap;
    use gonio_light::{Fresnel, Optics, Surfaces};
    use gonio_mesh::{Material, Mesh};
    use gonio_reference::ReferenceScene;
    use gonio_scene::scene_file::Shading;
    use gonio_scene::{Camera, Frame, LoadedEnvironment, Object, ObjectPart, Scene, SceneMaterial, Surroundings};
    use std::sync::Arc;

    /// The page about the middle of a pane that the eye looks at from 45 degrees.
    fn page(optics: Optics, lights: bool) -> String {
        let mesh = Mesh {
            positions: vec![[-9.0, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 3],
            indices: vec![0, 1, 2],
            ..Mesh::default()
        };
        let material = Material { emitted: [0.5; 3], refraction_index: 1.5, ..Material::default() };
        let part = ObjectPart { name: String::new(), first_triangle: 0, triangle_count: 1, material: 0 };
        // E is 0.2 where the pane reflects to, and 0.8 behind it.
        let map = Cubemap::from_function(64, |d| DVec3::splat(if d.z > 0.0 { 0.2 } else { 0.8 }));
        let scene = Scene {
            meshes: vec![std::sync::Arc::new(mesh)],
            materials: vec![SceneMaterial { optics, ..material.into() }],
            objects: vec![Object {
                name: "pane".into(),
                mesh: 0,
                shading: Shading::Phong,
                world_from_model: DMat4::IDENTITY,
                parts: vec![part],
                closed: false,
            }],
            environment: Some(Arc::new(LoadedEnvironment::new("two halves", map))),
            ..Scene::default()
        };
        let camera =
            Camera::looking_along(DVec3::new(-2.0, 0.0, 2.0), DVec3::new(1.0, 0.0, -1.0), DVec3::Y, 1.0, 0.1, 100.0);
        let surroundings = Some(Surroundings { lights, intensity: 2.0, ..Surroundings::default() });
        let frame = Frame { width: 3, height: 3, lights: Vec::new(), camera, surroundings, ..scene.frame(0.0) };
        let probe = ReferenceScene::new(&scene).probe(&frame, 1, 1).unwrap_or_else(|| panic!("the pane is hit"));
        let mut page = ProbePage::new(&scene, &frame);
        page.surroundings(&probe);
        page.text.for_terminal().to_owned()
    }

    #[track_caller]
    fn has(text: &str, lines: &[&str]) {
        for line in lines {
            let found = text.lines().any(|l| l.split_whitespace().collect::<Vec<_>>().join(" ").contains(line));
            assert!(found, "no `{line}` in\n{text}");
        }
    }

    #[test]
    fn glass_shows_its_terms_and_their_sum() {
        let glass = Optics { transmission: 0.5, reflectivity: 0.4, dispersion: 0.02, ..Optics::default() };
        let text = page(Optics { surfaces: Surfaces::Two, ..glass }, false);
        // R goes on to the right, out of the pane; E is doubled by the intensity.
        has(&text, &["environment `two halves`, intensity 2, it does not light the objects"]);
        has(&text, &["Fresnel none", "surfaces two", "indices 1.49 1.5 1.51", "absorption 0 0 0 per world unit"]);
        has(&text, &["R 0.70711 0 0.70711", "T 0.47140 0 -0.88192", "F 0 0 0", "E(R) 0.40000 0.40000 0.40000"]);
        has(&text, &["(1-F) * tint * E(T) 1.60000 1.60000 1.60000", "w 0.40000 = reflectivity", "L 1.03000 1.03000"]);
        has(&text, &["L = (1-t) * [ (1-w) * L_o + w * E(R) ] + t * [ F * E(R) + (1-F) * tint * E(T) ]"]);
        has(&text, &["red 1.03 = 0.5 * [ 0.6 * 0.5 + 0.4 * 0.4 ] + 0.5 * [ 0 * 0.4 + 1.6 ]"]);
        let text = page(Optics { fresnel: Fresnel::Exact, ..glass }, true);
        has(&text, &["Fresnel exact", "surfaces one", "w 0.02", "it lights the objects"]);
        has(&text, &["L = (1-t) * [ (1-w) * (L_o + diffuse + specular) + w * E(R) ]"]);
    }

    #[test]
    fn plain_surfaces_show_nothing_of_it() {
        let text = page(Optics::default(), false);
        has(&text, &["optics the material neither reflects nor transmits"]);
        assert!(!text.contains("L ="), "{text}");
        let text = page(Optics::default(), true);
        has(&text, &["L = L_o + diffuse + specular"]);
        let red = text.lines().map(str::trim).find(|l| l.starts_with("red")).unwrap_or_default();
        let numbers: Vec<f64> = red.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let [all, lit, diffuse, specular] = numbers[..] else { panic!("{red}") };
        // Half of the sphere is 0.4, the half before the pane, and k_d is 0.7; texels are some 0.02 rad.
        assert!(lit == 0.5 && (diffuse - 0.28).abs() < 2e-3 && specular > 0.0, "{red}");
        // Five digits each.
        assert!((all - lit - diffuse - specular).abs() < 2e-5, "{red}");
    }
}
