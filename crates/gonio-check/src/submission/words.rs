//! Names cut into words.

/// The words of a name, in small letters: cut at what is no letter or digit, where small letters turn to capitals,
/// and between letters and digits. `objectVertexShader_2` gives `object vertex shader 2`.
pub fn words_of(name: &str) -> Vec<String> {
    let chars: Vec<char> = name.chars().collect();
    let mut words: Vec<String> = Vec::new();
    let mut open = false;
    for (i, &c) in chars.iter().enumerate() {
        if !c.is_alphanumeric() {
            open = false;
            continue;
        }
        if let Some(previous) = i.checked_sub(1).and_then(|i| chars.get(i)) {
            let next_is_small = chars.get(i + 1).is_some_and(|c| c.is_lowercase());
            open &= !(c.is_uppercase() && (previous.is_lowercase() || previous.is_uppercase() && next_is_small));
            open &= c.is_numeric() == previous.is_numeric();
        }
        match words.last_mut() {
            Some(word) if open => word.extend(c.to_lowercase()),
            _ => words.push(c.to_lowercase().collect()),
        }
        open = true;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_cut_where_a_reader_would() {
        for (name, words) in [
            ("light_pos", "light pos"),
            ("lightPos", "light pos"),
            ("uMVPMatrix", "u mvp matrix"),
            ("itM", "it m"),
            ("MVP", "mvp"),
            ("tex0", "tex 0"),
            ("ex04-Phong.vert", "ex 04 phong vert"),
            ("__", ""),
            ("lumièreÉtat", "lumière état"),
        ] {
            assert_eq!(words_of(name).join(" "), words, "{name}");
        }
    }
}
