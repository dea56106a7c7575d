# Reports: pages, graders, JUnit

## Outcomes

report-correct = juste
report-wrong = faux
report-does-not-compile = ne compile pas
report-do-not-compile = ne compilent pas
report-unsure = n'a pas pu être jugé
report-right = juste

## Counts

report-count-submissions = { NUMBER($count) ->
        [one] { $count } rendu
       *[other] { $count } rendus
    }
report-count-similar-pairs = { NUMBER($count) ->
        [one] { $count } paire semblable
       *[other] { $count } paires semblables
    }
report-count-warnings = { NUMBER($count) ->
        [one] { $count } avertissement
       *[other] { $count } avertissements
    }
report-count-variables = { NUMBER($count) ->
        [one] { $count } variable
       *[other] { $count } variables
    }
report-count-lines-not-shown = { NUMBER($count) ->
        [one] { $count } ligne non montrée
       *[other] { $count } lignes non montrées
    }
report-scenes-right = { NUMBER($right) ->
        [one] { $right } scène juste
       *[other] { $right } scènes justes
    } sur { $count }

## What is not shown of a list

report-and-more = Et { $more } de plus.
report-and-more-messages = Et { $more } de plus. Corrigez d'abord les premiers.
report-and-more-lines = Et { NUMBER($count) ->
        [one] { $count } autre ligne.
       *[other] { $count } autres lignes.
    }
report-and-more-changes = Et { NUMBER($count) ->
        [one] { $count } autre modification.
       *[other] { $count } autres modifications.
    }
report-and-more-files = Et { NUMBER($count) ->
        [one] { $count } autre fichier.
       *[other] { $count } autres fichiers.
    }
report-and-more-pairs = Et { NUMBER($count) ->
        [one] { $count } autre paire.
       *[other] { $count } autres paires.
    }

## Graders and JUnit

report-term = terme { $term }
report-scene = scène : { $scene }
report-verdict = verdict
report-test = Test
report-result = Résultat
report-not-tested-separately-reason = non testé séparément : son intensité n'est pas un uniform
report-same-as-reference = comme la référence ({ $shows })
report-differs-from-reference = { $percent } des pixels diffèrent de la référence, d'au plus { $worst } ({ $shows })
report-where = {"  "}où : { $place }
report-explains-lines = {"  "}explique { $percent } de la différence
report-looks-like = ce que l'on voit
report-fix = comment corriger
report-lecture = dans le cours
report-heading = {"  "}{ $heading } : { $text }
report-outcome-and-summary = { $outcome } : { $summary }
report-other-method = juste, par une autre méthode : { $name }
report-warning = avertissement : { $text }
report-term-is-wrong = le terme { $term } est faux
report-pixels-differ = { $percent } des pixels diffèrent, d'au plus { $worst }
report-at = {"  "}en { $place }
report-explains = {"  "}explique { $percent } de la différence
report-to-fix-it = {"  "}pour corriger : { $fix }

## Parts of a verdict

report-line = , ligne { $line }
report-column = , colonne { $column }
report-score = Note { $percent }
report-what-is-wrong = Ce qui est faux
report-what-is-wrong-several = Ce qui est faux : { $several } erreurs
report-heading-looks-like = Ce que l'on voit
report-heading-fix = Comment corriger
report-heading-lecture = Dans le cours
report-alternatives = Autres possibilités
report-no-picture-distinguishes-these = { $names } (aucune image ne les distingue)
report-or =  ; ou :{" "}
report-note = Remarque
report-lab-does-it = Les solutions du TP font de même ; le cours, non.
report-it-explains = explique { $percent } de la différence
report-together-explains = explique, avec les autres, { $percent } de la différence
report-source-shows-it = le code source la montre
report-how-it-becomes-right = Comment le rendre juste
report-compiler-messages = Messages du compilateur
report-original-message = Message d'origine
report-whole-message = Message entier
report-property-wrong = Faux
report-property-right = Juste
report-consistency-checks = Tests de cohérence
report-heading-other-method = Juste, par une autre méthode
report-worth-knowing = Bon à savoir

## Pages of submissions

report-checked-by-gonio = Vérifié par gonio.
report-term-by-term = Terme par terme
report-not-tested-separately = non testé séparément
report-separate-terms = Un terme peut être testé séparément si son intensité est un uniform, que l'on peut mettre à 0.
report-scene-by-scene = Scène par scène
report-one-term-alone = Avec un seul terme : { $scenes }
report-yours = Votre image
report-reference = Référence
report-difference = Différence
report-your-method = Votre méthode
report-predicted = Prédiction
report-column-scene = Scène
report-large-pictures = Grandes images
report-large-pictures-of = Grandes images de { $scene }
report-measure = { $percent } des pixels diffèrent, d'au plus { $worst }
report-scale-or-more = { $full } ou plus
report-not-a-number = pas un nombre (NaN)
report-nothing-drawn = rien de dessiné
report-legend-your-method = Votre méthode : la référence, calculée avec votre méthode
report-legend-predicted = Prédiction : ce que dessine l'erreur
report-legend-predicted-together = Prédiction : ce que dessinent les erreurs ensemble
report-legend-difference = Différence : 0
report-own-method = La référence utilise sa propre méthode : là où la vôtre est juste par une autre méthode, les images peuvent différer bien que la scène soit juste.
report-linear-light = Les couleurs sont de la lumière linéaire, codée en sRGB pour l'écran : une fenêtre sans ce codage montre les mêmes nombres plus sombres.
report-unrecognised = non reconnue, mise à 0
report-some-unrecognised = { $variables }, dont { $some } non reconnues
report-names-file = Un fichier <code>names.toml</code> à côté des shaders peut leur donner des rôles.
report-variables-and-roles = Variables et leurs rôles
report-column-name = Nom
report-column-type = Type
report-column-role = Rôle
report-code = Code
report-class = Classe
report-all-submissions = Tous les rendus
report-no-name = (sans nom)

## The overview of a class

report-mistakes = Erreurs
report-similar-submissions = Rendus semblables
report-similarity-hint = La mise en page, les commentaires, les noms et les fichiers de départ sont ignorés. Une ressemblance est une raison de regarder, pas une preuve : les réponses justes et courtes se ressemblent.
report-pair = { $first } et { $second } : { $percent }
report-similar-group = { $submissions }, identiques jusqu'à { $percent }
report-not-checked = Non vérifié
report-submissions = Rendus
report-filter = Filtrer par nom, verdict ou erreur
report-filtered = $count sur $all
report-column-picture = Image
report-column-exercise = Exercice
report-column-verdict = Verdict
report-column-points = Points
report-of-points = sur { $most }
report-column-first-finding = Premier constat
report-points-hint = Une réponse juste vaut { $most } points, et une réponse qui ne compile pas n'en vaut aucun ; les autres ont la part de { $most } qui est juste, en scènes de test pour les shaders.
report-points-hint-of-course = Une réponse juste vaut { $most } points, et une réponse qui ne compile pas n'en vaut aucun ; aux autres, le cours retire ce que coûtent leurs erreurs ou leurs termes faux.
report-submitted = Rendu
report-correct-picture = Juste
report-of-pixels-differ = { $percent } des pixels diffèrent
