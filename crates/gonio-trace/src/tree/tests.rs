use super::*;
use crate::sampler::Sampler;

/// Small triangles everywhere in the unit cube, and a few large ones.
fn cloud(count: u32) -> Vec<[Vec3; 3]> {
    (0..count)
        .map(|i| {
            let mut random = Sampler::new(5, i, 0);
            let mut point = || random.next_2d().extend(random.next_1d());
            let (center, size) = (point(), if i % 50 == 0 { 0.5 } else { 0.05 });
            [0, 1, 2].map(|_| center + size * (point() - 0.5))
        })
        .collect()
}

/// One triangle after the other.
struct BruteForce<'a> {
    corners: &'a [[Vec3; 3]],
    ray: &'a Ray,
}

impl Kernel for BruteForce<'_> {
    type Output = Option<Hit>;

    fn run<S: Simd>(self, simd: S) -> Option<Hit> {
        let sheared = ShearedRay::new(simd, self.ray, &inverse(self.ray.direction));
        let hits = (0..self.corners.len() as u32)
            .filter_map(|i| Packet::new(&[i], self.corners).nearest(simd, &sheared, self.ray.reach));
        hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }
}

#[test]
fn the_tree_loses_no_triangle() {
    let corners = cloud(3000);
    let trees: Vec<Tree> = SimdLevel::available().iter().map(|&level| Tree { level, ..Tree::new(&corners) }).collect();
    let mut hits = 0;
    for i in 0..2000 {
        let mut random = Sampler::new(9, i, 0);
        let mut point = || random.next_2d().extend(random.next_1d());
        let (origin, target) = (point() * 2.0 - 0.5, point());
        let mut direction = (target - origin).normalize();
        if i % 4 == 0 {
            direction = [Vec3::X, Vec3::Y, Vec3::Z][i as usize / 4 % 3] * if i % 8 == 0 { 1.0 } else { -1.0 };
        }
        let reach = if i % 3 == 0 { 0.3 } else { f32::INFINITY };
        let ray = Ray { origin, direction, reach };
        let expected = SimdLevel::Baseline.run(BruteForce { corners: &corners, ray: &ray });
        for tree in &trees {
            assert_eq!(tree.nearest(&ray), expected, "ray {i}, {}", tree.level.name());
            assert_eq!(tree.is_blocked(&ray), expected.is_some(), "ray {i}, {}", tree.level.name());
        }
        hits += u32::from(expected.is_some());
    }
    assert!(hits > 500, "{hits}");
}

/// From inside, every ray meets a closed body: here a sphere of 8 to 8,000 triangles that share their corners.
#[test]
fn no_ray_leaves_a_closed_body() {
    for rings in [2_usize, 9, 60] {
        let corner = |ring: usize, slice: usize| {
            let (polar, turn) = (ring as f32 / rings as f32, (slice % (2 * rings)) as f32 / (2 * rings) as f32);
            crate::sampling::from_polar((std::f32::consts::PI * polar).cos(), turn)
        };
        let mut corners = Vec::new();
        for ring in 0..rings {
            for slice in 0..2 * rings {
                let (a, b) = (corner(ring, slice), corner(ring, slice + 1));
                let (c, d) = (corner(ring + 1, slice), corner(ring + 1, slice + 1));
                corners.extend([[a, c, b], [b, c, d]]);
            }
        }
        let tree = Tree::new(&corners);
        for i in 0..20_000 {
            let mut random = Sampler::new(2, i, 0);
            let origin = 0.4 * (random.next_2d().extend(random.next_1d()) - 0.5);
            // Towards corners and edges too, where a ray passes between triangles if it can.
            let target = match i % 3 {
                0 => corners[i as usize % corners.len()][0],
                1 => corners[i as usize % corners.len()][0]
                    .lerp(corners[i as usize % corners.len()][1], random.next_1d()),
                _ => crate::sampling::from_polar(2.0 * random.next_1d() - 1.0, random.next_1d()),
            };
            let direction = (target - origin).normalize();
            assert!(
                tree.nearest(&Ray { origin, direction, reach: f32::INFINITY }).is_some(),
                "{rings} rings: ray {i} from {origin} along {direction}"
            );
        }
    }
}

#[test]
fn places_and_weights_are_those_of_the_hit() {
    let corners = vec![[Vec3::new(-1.0, -1.0, 2.0), Vec3::new(3.0, -1.0, 4.0), Vec3::new(-1.0, 2.0, 3.0)]];
    let weights = Vec3::new(0.2, 0.3, 0.5);
    let target = corners[0][0] * weights.x + corners[0][1] * weights.y + corners[0][2] * weights.z;
    let ray = Ray { origin: Vec3::ZERO, direction: target.normalize(), reach: f32::INFINITY };
    let hit = Tree::new(&corners).nearest(&ray).expect("inside");
    // A few roundings in f32.
    assert!((hit.distance - target.length()).abs() < 1e-5 && (hit.barycentrics - weights).abs().max_element() < 1e-6);
    assert_eq!(hit.triangle, 0);
}

#[test]
fn thousands_of_equal_triangles_are_no_trouble() {
    let corners = vec![[Vec3::ZERO, Vec3::X, Vec3::Y]; 20_000];
    let tree = Tree::new(&corners);
    let ray = Ray { origin: Vec3::new(0.2, 0.2, 1.0), direction: -Vec3::Z, reach: f32::INFINITY };
    assert!(tree.nearest(&ray).is_some_and(|hit| hit.distance == 1.0));
    assert!(Tree::new(&[]).nearest(&ray).is_none());
    let flat = vec![[Vec3::ZERO, Vec3::X, Vec3::X * 2.0]];
    assert!(Tree::new(&flat).nearest(&ray).is_none());
}
