# Verdicts in a terminal.

terminal-correct = juste
terminal-right = juste
terminal-wrong = faux
terminal-does-not-compile = ne se compile pas
terminal-unsure = non jugé
terminal-not-tested-separately = non testé séparément
terminal-terms = Termes
terminal-scenes = Scènes
terminal-pixels-differ = { $percent } % des pixels diffèrent
terminal-consistency-checks = Contrôles de cohérence
terminal-another-method = Juste, par une autre méthode
terminal-worth-knowing = Bon à savoir
terminal-unrecognised-uniforms = Uniforms non reconnus, mis à 0 : { $names } (names.toml peut dire ce qu'ils sont)
terminal-it-explains = Elle explique { $percent } % de la différence.
terminal-the-source-shows-it = Elle se voit dans le code ; sa part de la différence est inconnue.
terminal-not-distinguished-from = Aucune image ne la distingue de : { $ids }.
terminal-what-it-looks-like = Ce qu'on voit :
terminal-how-to-fix-it = Comment corriger :
terminal-in-the-lecture = Dans le cours :
terminal-the-lab-does-it-too = La solution du TP fait de même ; --as-the-lab l'accepte.
