# Reports: pages, graders, JUnit

## Outcomes

report-correct = correct
report-wrong = wrong
report-does-not-compile = does not compile
report-do-not-compile = do not compile
report-unsure = could not be judged
report-right = right

## Counts

report-count-submissions = { NUMBER($count) ->
        [one] { $count } submission
       *[other] { $count } submissions
    }
report-count-similar-pairs = { NUMBER($count) ->
        [one] { $count } similar pair
       *[other] { $count } similar pairs
    }
report-count-warnings = { NUMBER($count) ->
        [one] { $count } warning
       *[other] { $count } warnings
    }
report-count-variables = { NUMBER($count) ->
        [one] { $count } variable
       *[other] { $count } variables
    }
report-count-lines-not-shown = { NUMBER($count) ->
        [one] { $count } line not shown
       *[other] { $count } lines not shown
    }
report-scenes-right = { $right } of { NUMBER($count) ->
        [one] { $count } scene right
       *[other] { $count } scenes right
    }

## What is not shown of a list

report-and-more = And { $more } more.
report-and-more-messages = And { $more } more. Fix the first ones first.
report-and-more-lines = And { NUMBER($count) ->
        [one] { $count } more line.
       *[other] { $count } more lines.
    }
report-and-more-changes = And { NUMBER($count) ->
        [one] { $count } more change.
       *[other] { $count } more changes.
    }
report-and-more-files = And { NUMBER($count) ->
        [one] { $count } more file.
       *[other] { $count } more files.
    }
report-and-more-pairs = And { NUMBER($count) ->
        [one] { $count } more pair.
       *[other] { $count } more pairs.
    }

## Graders and JUnit

report-term = { $term } term
report-scene = scene: { $scene }
report-verdict = verdict
report-test = Test
report-result = Result
report-not-tested-separately-reason = not tested separately: its strength is not a uniform
report-same-as-reference = the same as the reference ({ $shows })
report-differs-from-reference = { $percent } of pixels differ from the reference, by up to { $worst } ({ $shows })
report-where = {"  "}where: { $place }
report-explains-lines = {"  "}it explains { $percent } of the difference
report-looks-like = what it looks like
report-fix = how to fix it
report-lecture = in the lecture
report-heading = {"  "}{ $heading }: { $text }
report-outcome-and-summary = { $outcome }: { $summary }
report-other-method = correct, by a different method: { $name }
report-warning = warning: { $text }
report-term-is-wrong = the { $term } term is wrong
report-pixels-differ = { $percent } of pixels differ, by up to { $worst }
report-at = {"  "}at { $place }
report-explains = {"  "}explains { $percent } of the difference
report-to-fix-it = {"  "}to fix it: { $fix }

## Parts of a verdict

report-line = , line { $line }
report-column = , column { $column }
report-score = Score { $percent }
report-what-is-wrong = What is wrong
report-what-is-wrong-several = What is wrong: { $several } mistakes
report-heading-looks-like = What it looks like
report-heading-fix = How to fix it
report-heading-lecture = In the lecture
report-alternatives = Alternatives
report-no-picture-distinguishes-these = { $names } (no picture distinguishes these)
report-or = ; or:{" "}
report-note = Note
report-lab-does-it = The lab’s own solutions do the same; the textbook does not.
report-it-explains = it explains { $percent } of the difference
report-together-explains = together with the others, it explains { $percent } of the difference
report-source-shows-it = the source shows it
report-how-it-becomes-right = How it becomes right
report-compiler-messages = Compiler messages
report-original-message = Original message
report-whole-message = Whole message
report-property-wrong = Wrong
report-property-right = Right
report-consistency-checks = Consistency checks
report-heading-other-method = Correct, by a different method
report-worth-knowing = Worth knowing

## Pages of submissions

report-checked-by-gonio = Checked by gonio.
report-term-by-term = Term by term
report-not-tested-separately = not tested separately
report-separate-terms = A term can be tested separately if its strength is a uniform, which can be set to 0.
report-scene-by-scene = Scene by scene
report-one-term-alone = With one term alone: { $scenes }
report-yours = Yours
report-reference = Reference
report-difference = Difference
report-your-method = Your method
report-predicted = Predicted
report-column-scene = Scene
report-large-pictures = Large pictures
report-large-pictures-of = Large pictures of { $scene }
report-measure = { $percent } of pixels differ, by up to { $worst }
report-scale-or-more = { $full } or more
report-not-a-number = not a number (NaN)
report-nothing-drawn = nothing drawn
report-legend-your-method = Your method: the reference, computed with your method
report-legend-predicted = Predicted: what the mistake draws
report-legend-predicted-together = Predicted: what the mistakes draw together
report-legend-difference = Difference: 0
report-own-method = The reference uses its own method: where yours is correct by a different method, the pictures may differ although the scene is right.
report-linear-light = Colours are linear light, encoded as sRGB for the screen: a window without that encoding shows the same numbers darker.
report-unrecognised = unrecognised, set to 0
report-some-unrecognised = { $variables }, { $some } unrecognised
report-names-file = A file <code>names.toml</code> beside the shaders can assign their roles.
report-variables-and-roles = Variables and their roles
report-column-name = Name
report-column-type = Type
report-column-role = Role
report-code = Code
report-class = Class
report-all-submissions = All submissions
report-no-name = (no name)

## The overview of a class

report-mistakes = Mistakes
report-similar-submissions = Similar submissions
report-similarity-hint = Layout, comments, names and the start files are ignored. Similarity is a reason to look, not a proof: short right answers are similar.
report-pair = { $first } and { $second }: { $percent }
report-similar-group = { $submissions }, up to { $percent } the same
report-not-checked = Not checked
report-submissions = Submissions
report-filter = Filter by name, verdict or mistake
report-filtered = $count of $all shown
report-column-picture = Picture
report-column-exercise = Exercise
report-column-verdict = Verdict
report-column-points = Points
report-of-points = of { $most }
report-column-first-finding = First finding
report-points-hint = A correct answer has { $most } points, and one that does not compile none; others have the share of { $most } that is right, of the test scenes for shaders.
report-points-hint-of-course = A correct answer has { $most } points, and one that does not compile none; from others the course takes what their mistakes or their wrong terms cost.
report-submitted = Submitted
report-correct-picture = Correct
report-of-pixels-differ = { $percent } of pixels differ
