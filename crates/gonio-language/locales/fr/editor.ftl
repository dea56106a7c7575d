# Messages dans les éditeurs, de `gonio lsp`.

editor-advice = Conseil :
editor-fix = Appliquer la modification qui rend toutes les scènes de test justes
editor-rename = Remplacer par { $name }
editor-correct = { $exercise } est juste : { $summary }
editor-unavailable = gonio ne peut pas vérifier ici : { $reason }. Il signale encore les erreurs de syntaxe et de type, les valeurs des variables et les lignes dont les valeurs sont fausses.
editor-role = Rôle : { $role } ({ $how })
editor-at-pixel = au pixel { $x },{ $y } de { $scene }
editor-at-vertex = au sommet { $vertex } de { $scene }
editor-value = Valeur : { $value }, { $place }
editor-values = Valeurs : { $values } ({ $count } évaluations, { $place })
editor-not-evaluated = Non évalué { $place }
