//! Products and sums of the equation's quantities that model solutions compute within a line.

use super::values::Values;

/// Adds terms times colour and attenuation, as programs compute them.
pub(super) fn products<'q>(push: &mut impl FnMut(&str, Values), of: &dyn Fn(&str) -> Option<&'q Values>) {
    let (Some(material), Some(attenuation)) = (of("materialColour"), of("attenuation")) else { return };
    let times = |a: &Values, b: &Values| {
        a.map(3, |point, a, to| {
            let b = b.at(point);
            for (channel, to) in to.iter_mut().enumerate() {
                *to = a[channel.min(a.len() - 1)] * b[channel.min(b.len() - 1)];
            }
        })
    };
    let scaled =
        |a: &Values, b: &Values| a.map(1, |point, a, to| to[0] = a[0] * b.at(point).first().copied().unwrap_or(1.0));
    for term in ["ambient", "diffuse", "specular", "cos_theta", "spec", "ward", "lit", "attenuated"] {
        let Some(values) = of(term) else { continue };
        let grey = values.map(3, |_, a, to| to.fill(a[0]));
        push(term, grey);
        // A sum in the object's colour has a line of its own, or lacks a term.
        if !["lit", "attenuated"].contains(&term) {
            push(&format!("materialColour * {term}"), times(values, material));
        }
        if !["ambient", "lit", "attenuated"].contains(&term) {
            let attenuated = scaled(values, attenuation);
            push(&format!("attenuation * {term}"), attenuated.map(3, |_, a, to| to.fill(a[0])));
            push(&format!("materialColour * attenuation * {term}"), times(&attenuated, material));
            // Model solutions have lines for these two.
            if !["diffuse", "specular"].contains(&term) {
                push(&format!("attenuation * {term}"), attenuated);
            }
        }
    }
    if let (Some(diffuse), Some(specular)) = (of("diffuse"), of("specular")) {
        let sum = diffuse.map(1, |point, a, to| to[0] = a[0] + specular.at(point)[0]);
        push("materialColour * (diffuse + specular)", times(&sum, material));
        push("diffuse + specular", sum.map(3, |_, a, to| to.fill(a[0])));
        push("diffuse + specular", sum);
    }
}
