//! Commands of the bench's widgets and keys.

use crate::saving::Product;
use gonio_bsdf::BsdfModel;

/// A request that is carried out after everything was shown.
#[derive(Clone, Copy, Debug)]
pub enum BenchCommand {
    /// Adds a model with its defaults.
    Add(&'static BsdfModel),
    /// Shows the file dialog.
    Open,
    /// Saves the plot.
    Save(Product),
    /// Checks the chosen function.
    Check,
    /// Goes back to the scene.
    Leave,
    /// Switches the theme.
    Theme,
}
