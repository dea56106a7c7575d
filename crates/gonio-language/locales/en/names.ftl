# Names and descriptions that other crates have in English: see `gonio_language::name`. Other languages have them here.
