//! The known name that a misspelt one was probably meant to be.

/// The nearest of `names`, if it is near enough: a third of the letters may differ, and case counts for little.
pub(crate) fn nearest<'n>(wanted: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let most = (wanted.chars().count() * 2 / 3).min(5);
    names
        .filter(|n| *n != wanted && n.len() < 100 && wanted.len() < 100)
        .map(|name| (distance(wanted, name), name))
        .filter(|(d, _)| *d <= most)
        .min_by_key(|(d, _)| *d)
        .map(|(_, name)| name)
}

/// Edits between two words (Levenshtein, with neighbours swapped as one), each counting 2, another case 1.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for (i, row) in rows.iter_mut().enumerate() {
        row[0] = 2 * i;
    }
    for (j, cell) in rows[0].iter_mut().enumerate() {
        *cell = 2 * j;
    }
    for i in 1..=a.len() {
        for j in 1..=b.len() {
            let change = if a[i - 1] == b[j - 1] {
                0
            } else if a[i - 1].eq_ignore_ascii_case(&b[j - 1]) {
                1
            } else {
                2
            };
            let mut best = (rows[i - 1][j - 1] + change).min(rows[i - 1][j] + 2).min(rows[i][j - 1] + 2);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 2);
            }
            rows[i][j] = best;
        }
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_misspelt_find_their_name() {
        let names = ["normalize", "position", "light_pos", "v_normal"];
        for (wanted, found) in [
            ("normalise", Some("normalize")),
            ("postion", Some("position")),
            ("Position", Some("position")),
            ("lightPos", Some("light_pos")),
            ("v_noraml", Some("v_normal")),
            ("shininess", None),
        ] {
            assert_eq!(nearest(wanted, names.into_iter()), found, "{wanted}");
        }
    }
}
