# Messages in editors, from `gonio lsp`.

editor-advice = Advice:
editor-fix = Apply the change with which every test scene is right
editor-rename = Replace it by { $name }
editor-correct = { $exercise } is correct: { $summary }
editor-unavailable = gonio cannot check here: { $reason }. It still reports errors of syntax and types, values of variables, and lines with wrong values.
editor-role = Role: { $role } ({ $how })
editor-at-pixel = at pixel { $x },{ $y } of { $scene }
editor-at-vertex = at vertex { $vertex } of { $scene }
editor-value = Value: { $value }, { $place }
editor-values = Values: { $values } ({ $count } evaluations, { $place })
editor-not-evaluated = Not evaluated { $place }
