# Verdicts in a terminal.

terminal-correct = correct
terminal-right = right
terminal-wrong = wrong
terminal-does-not-compile = does not compile
terminal-unsure = unsure
terminal-not-tested-separately = not tested separately
terminal-terms = Terms
terminal-scenes = Scenes
terminal-pixels-differ = { $percent } % of pixels differ
terminal-consistency-checks = Consistency checks
terminal-another-method = Correct, by a different method
terminal-worth-knowing = Worth knowing
terminal-unrecognised-uniforms = Unrecognised uniforms, set to 0: { $names } (names.toml can state what they are)
terminal-it-explains = It explains { $percent } % of the difference.
terminal-the-source-shows-it = The source shows it; its share of the difference is unknown.
terminal-not-distinguished-from = No picture distinguishes it from: { $ids }.
terminal-what-it-looks-like = What it looks like:
terminal-how-to-fix-it = How to fix it:
terminal-in-the-lecture = In the lecture:
terminal-the-lab-does-it-too = The lab's own solution does the same; --as-the-lab accepts it.
