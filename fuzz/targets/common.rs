//! Checks of models that every target applies: a model is consistent, and every operation on models works with it.

use gonio_mesh::{Limits, MissingSidecar, Model, Sidecar, Sidecars, normals, tangents, topology, write};

/// Returns limits so tight that a hundred bytes cannot allocate gigabytes unnoticed.
pub fn limits() -> Limits {
    Limits { max_vertices: 1 << 20, max_triangles: 1 << 20, max_bytes: 1 << 20 }
}

/// Returns these bytes for every file name: about half of the libraries and buffers then make some sense.
pub struct Echo<'a>(pub &'a [u8]);

impl Sidecars for Echo<'_> {
    fn read(&mut self, name: &str) -> Result<Sidecar, MissingSidecar> {
        if name.is_empty() {
            return Err(MissingSidecar { tried: vec![name.to_owned()], refused: None });
        }
        Ok(Sidecar { path: name.to_owned(), bytes: self.0.to_vec() })
    }
}

/// Panics if the model is not consistent.
pub fn check(model: Model) {
    let mesh = &model.mesh;
    let count = mesh.positions.len();
    assert!(mesh.indices.len().is_multiple_of(3));
    assert!(mesh.indices.iter().all(|&i| (i as usize) < count));
    assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
    for length in [mesh.normals.len(), mesh.tex_coords.len(), mesh.tangents.len(), mesh.colors.len()] {
        assert!(length == 0 || length == count);
    }
    assert!(mesh.normals.iter().flatten().all(|x| x.is_finite()));
    assert!(mesh.tex_coords.iter().flatten().all(|x| x.is_finite()));
    assert!(mesh.colors.iter().flatten().all(|x| x.is_finite()));
    assert!(mesh.smoothing_groups.is_empty() || mesh.smoothing_groups.len() == mesh.triangle_count());
    let mut next = 0;
    for part in &mesh.parts {
        assert_eq!(part.first_triangle, next);
        assert!(part.material < model.materials.len());
        next += part.triangle_count;
    }
    assert_eq!(next, mesh.triangle_count());
    for material in &model.materials {
        let numbers = [material.diffuse, material.specular, material.emitted];
        assert!(numbers.iter().flatten().all(|x| x.is_finite() && *x >= 0.0));
        assert!(material.shininess >= 1.0 && (0.0..=1.0).contains(&material.opacity));
    }
    // The rest is slow for large meshes, which show nothing new.
    if mesh.triangle_count() > 4096 {
        return;
    }
    topology::report(mesh);
    let (complete, _) = normals::complete(mesh.clone());
    assert_eq!(complete.normals.len(), complete.positions.len());
    assert!(complete.normals.iter().flatten().all(|x| x.is_finite()));
    tangents::with_tangents(&complete);
    write::ply::write(&model, "m", write::ply::PlyEncoding::Binary);
    write::obj::write(&model, "m.mtl");
    let _ = write::glb::write(&model, &mut |_| None);
}
