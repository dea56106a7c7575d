//! The paper and the inks of the drawing.
//!
//! The dyes' maxima are those of solutions in water or ethanol: pyranine 454 and 511 nm, fluorescein 490 and 515 nm, rhodamine 6G
//! 530 and 556 nm, rhodamine B 554 and 577 nm, coumarin 1 373 and 446 nm (H. Du et al., *PhotochemCAD*, Photochemistry and
//! Photobiology 68, 1998). The second bell stands for the weaker absorption in the ultraviolet. Heights and widths are
//! chosen, and the emission of the inks lies at longer wavelengths, as in thick layers, which absorb their own light.

use super::reradiation::{Dye, ReradiationMatrix, bell};

/// A coloured part of the drawing.
#[derive(Clone, Copy, Debug)]
pub struct Ink {
    /// The name.
    pub name: &'static str,
    dye: Dye,
    /// Light that the ink absorbs without emitting any: height, middle, width.
    filter: [f64; 3],
}

/// Paper has an optical brightener, which is a dye too.
pub const PAPER: Ink = Ink {
    name: "paper",
    dye: Dye { absorption: [[0.80, 365.0, 18.0], [0.0, 1.0, 1.0]], emission: [440.0, 24.0], quantum_yield: 0.34 },
    filter: [0.0, 1.0, 1.0],
};

/// Yellow: pyranine.
pub const YELLOW: Ink = Ink {
    name: "yellow ink",
    dye: Dye { absorption: [[0.96, 452.0, 22.0], [0.86, 375.0, 26.0]], emission: [520.0, 20.0], quantum_yield: 0.92 },
    filter: [0.0, 1.0, 1.0],
};

/// Green: fluorescein with a blue-green filter.
pub const GREEN: Ink = Ink {
    name: "green ink",
    dye: Dye { absorption: [[0.80, 440.0, 26.0], [0.80, 365.0, 30.0]], emission: [507.0, 15.0], quantum_yield: 0.72 },
    filter: [0.80, 650.0, 45.0],
};

/// Orange: rhodamine 6G.
pub const ORANGE: Ink = Ink {
    name: "orange ink",
    dye: Dye { absorption: [[0.97, 515.0, 26.0], [0.80, 362.0, 34.0]], emission: [588.0, 14.0], quantum_yield: 0.90 },
    filter: [0.85, 460.0, 34.0],
};

/// Pink: rhodamine B.
pub const PINK: Ink = Ink {
    name: "pink ink",
    dye: Dye { absorption: [[0.95, 548.0, 20.0], [0.78, 358.0, 36.0]], emission: [612.0, 15.0], quantum_yield: 0.78 },
    filter: [0.0, 1.0, 1.0],
};

/// Blue: a coumarin with a blue filter.
pub const BLUE: Ink = Ink {
    name: "blue ink",
    dye: Dye { absorption: [[0.95, 373.0, 22.0], [0.0, 1.0, 1.0]], emission: [452.0, 17.0], quantum_yield: 0.85 },
    filter: [0.85, 610.0, 52.0],
};

/// The paper and all inks.
pub const ALL: [Ink; 6] = [PAPER, YELLOW, GREEN, ORANGE, PINK, BLUE];

impl Ink {
    /// The reflectance below the dye.
    pub fn surface(&self, lambda: f64) -> f64 {
        let [height, center, width] = self.filter;
        0.86 * (1.0 - height * bell(lambda, center, width))
    }

    /// The dye.
    pub fn dye(&self) -> &Dye {
        &self.dye
    }

    /// The matrix with a share of the dye.
    pub fn matrix(&self, strength: f64) -> ReradiationMatrix {
        ReradiationMatrix::new(|lambda| self.surface(lambda), &self.dye, strength)
    }
}
