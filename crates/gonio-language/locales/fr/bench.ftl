# bench

## baking/mod

bench-the-baked-atlas-could-not-be = l'atlas précalculé n'a pas pu être affiché : sa préparation a échoué

## baking/panel

bench-256-x-256-texels = 256 x 256 texels
bench-512-x-512-texels = 512 x 512 texels
bench-1024-x-1024-texels = 1024 x 1024 texels
bench-2048-x-2048-texels = 2048 x 2048 texels
bench-4096-x-4096-texels-64-mb = 4096 x 4096 texels : 64 Mo par carte tant qu'elle est affichée
bench-one-is-enough-for-textures-which = Un seul suffit pour les textures, qui sont filtrées
bench-four-samples-of-each-texel-smooth = Quatre échantillons par texel lissent les bords des matériaux et des ombres
bench-nine-samples-of-each-texel = Neuf échantillons par texel
bench-sixteen-samples-of-each-texel = Seize échantillons par texel
bench-unwrap = Déplier
bench-new-texture-coordinates-charts-without-overlaps = Nouvelles coordonnées de texture : îlots sans recouvrement, rangés dans un même carré
bench-repack = Ranger
bench-the-model-s-own-charts-packed = Les îlots du modèle, rangés à nouveau avec une densité égale
bench-keep-uvs = Garder les UV
bench-the-model-s-own-texture-coordinates = Les coordonnées de texture du modèle, qui ne doivent pas se recouvrir
bench-original = Original
bench-the-scene-s-own-materials = Les matériaux d'origine de la scène
bench-baked = Précalculé
bench-the-materials-of-the-baked-model = Les matériaux du modèle précalculé, éclairés par les lumières de la scène
bench-picture = Image
bench-the-picture-that-the-atlas-shows = L'image que montre l'atlas, sans aucune lumière : une carte, les îlots ou le damier
bench-the-diffuse-colour-k-d-with = La couleur diffuse k_d, avec sa texture et les couleurs des sommets
bench-the-specular-colour-k-s-with = La couleur spéculaire k_s, avec sa texture
bench-the-normal-in-tangent-space-mikktspace = La normale dans l'espace tangent (MikkTSpace), le vert vers le haut
bench-the-share-of-the-hemisphere-that = La part de l'hémisphère qu'aucune surface ne couvre
bench-the-scene-s-light-on-the = La lumière de la scène sur la surface, linéaire (OpenEXR)
bench-the-position-in-world-space-openexr = La position dans l'espace du monde (OpenEXR)
bench-the-emitted-light-e-with-its = La lumière émise E, avec sa texture
bench-a-colour-for-each-part-of = Une couleur pour chaque partie de chaque objet
bench-the-scene-has-changed-since-bake = La scène a changé depuis : relancez le précalcul pour mettre à jour les textures.
bench-settings = Réglages
bench-what-is-baked-and-how = Ce qui est précalculé, et comment
bench-the-charts-over-the-baked-maps = Les îlots sur les cartes précalculées
bench-page = Page
bench-close-the-atlas-and-the-settings = Fermer l'atlas et les réglages du précalcul
bench-texture = Texture
bench-the-texture-coordinates-to-bake-for = Les coordonnées de texture du précalcul
bench-layout = Disposition
bench-the-model-has-no-texture-coordinates = Le modèle n'a pas de coordonnées de texture à garder.
bench-texels-along-a-side = Texels le long d'un côté
bench-size = Taille
bench-samples-of-each-texel = Échantillons par texel
bench-samples = Échantillons
bench-the-distance-between-charts-as-a = La distance entre les îlots, en proportion du côté
bench-texels = { NUMBER($count) ->
    [one] { $count } texel
    *[other] { $count } texels
    }
bench-rays-of-each-texel-for-ambient = Rayons par texel pour l'occlusion ambiante
bench-rays = Rayons
bench-bake-again = Recalculer
bench-bake-textures = Précalculer
bench-there-is-no-triangle-to-bake = Il n'y a aucun triangle à précalculer.
bench-choose-at-least-one-map = Choisissez au moins une carte.
bench-triangles = { NUMBER($count) ->
    [one] { $count } triangle
    *[other] { $count } triangles
    }
bench-error = Erreur
bench-preparing-the-atlas = préparation de l'atlas
bench-about = , environ { $left }
bench-cancel = Annuler
bench-progress = Progression
bench-s-left = { $seconds } s restantes
bench-min-left = { $seconds } min restantes
bench-on-the-model = Sur le modèle
bench-wipe = Volet
bench-the-original-and-the-baked-model = L'original et le modèle précalculé superposés, avec une séparation à faire glisser
bench-difference = Différence
bench-colour-map-of-the-difference-between = La différence entre l'original et le modèle précalculé, en fausses couleurs
bench-one-picture = Une image
bench-a-single-pane-again = Revenir à une seule vue
bench-baked-in-s = Précalculé en { $seconds } s
bench-time = Durée
bench-save-2 = Enregistrer
bench-the-model-as-obj-and-mtl = Le modèle en .obj et .mtl, accompagné de ses cartes et de la disposition
bench-one-file-with-the-model-and = Un seul fichier avec le modèle et les cartes qu'utilisent ses matériaux
bench-all-files-in-one-obj-mtl = Tous les fichiers en un seul : .obj, .mtl, .glb, les cartes et la disposition
bench-save = Enregistrer { $title }
bench-atlas = Atlas
bake-charts = Îlots
bench-connected-pieces-of-the-surface = Morceaux connexes de la surface
bake-coverage = Couverture
bench-the-share-of-the-texture-that = La part de la texture que couvrent les triangles
bake-overlaps = Recouvrements
bench-texels-that-two-or-more-triangles = Texels couverts par au moins deux triangles
bake-angle-stretch = Déformation des angles
bench-1-keeps-all-angles = 1 conserve tous les angles
bake-area-stretch = Déformation des aires
bench-1-keeps-all-areas = 1 conserve toutes les aires
bake-density = Densité
bench-texels-per-unit = { NUMBER($texels_per_unit) ->
    [one] { $texels_per_unit } texel par unité
    *[other] { $texels_per_unit } texels par unité
    }
bench-texels-per-unit-of-length-in = Texels par unité de longueur dans l'espace du monde
bench-margin = Marge
bench-the-distance-between-charts = La distance entre les îlots
bake-degenerate = Dégénérés
bake-collapsed = Aplatis
bake-mirrored = Retournés

## baking/view

bench-texture-atlas = atlas de texture, { $background }
bench-each-chart-in-a-colour-of = Chaque îlot dans sa propre couleur, avec ses triangles
bench-checker = Damier
bench-squares-with-picture-on-the-model = Des carrés : avec « Image » sur le modèle, ils en montrent la déformation
bench-picture-of-the-atlas = Image de l'atlas
bench-show-the-whole-atlas = Afficher tout l'atlas
bench-zoom-out = Zoom arrière
bench-zoom-in = Zoom avant
bench-outline-the-charts = Tracer le contour des îlots
bench-point-at-a-chart-its-place = Pointez un îlot : sa place sur le modèle est marquée. Un clic la garde.
bench-marked-texel = Texel marqué
bench-of = {" "}de { $name }
bench-texel-chart = Texel { $column }, { $row }, îlot { $chart }{ $object }

## bench/checks

bench-checks = Vérifications
bench-check = Vérifier
bench-reciprocity-energy-positivity-normalisation-and-chi = Réciprocité, énergie, positivité ; normalisation et khi-deux des échantillons
bench-below = Ci-dessous : { $name }

## bench/functions

bench-was-not-added-the-bench-holds = `{ $name }` n'a pas été ajoutée : le banc contient { $MOST_FUNCTIONS } fonctions, retirez-en d'abord une
bench-a-file-could-not-be-read = un fichier n'a pas pu être lu : la lecture s'est arrêtée de façon inattendue

## bench/list

bench-add-a-model-or-open-a = Ajoutez un modèle, ou ouvrez un fichier .binary, .brdf ou .glsl ; vous pouvez aussi déposer des fichiers ici.
bench-show-or-hide-the-parameters = Afficher ou masquer les paramètres
bench-click-check-this-function = { $title }
    Clic : vérifier cette fonction
bench-remove-this-function = Retirer cette fonction
bench-shown-hide-it = Affichée : la masquer
bench-hidden-show-it = Masquée : l'afficher
bench-no-parameters = aucun paramètre

## bench/mod

bench-bench-page = page du banc
bench-plot = Graphique
bench-functions = Fonctions

## bench/paint

bench-bench-picture = image du banc

## bench/plot

bench-the-computation-ended-unexpectedly = le calcul s'est arrêté de façon inattendue
bench-plot-of-light-at-degrees = graphique de { $functions } ({ $name }), lumière à { $degrees } degrés
bench-no-function-is-shown-add-a = Aucune fonction n'est affichée : ajoutez un modèle, ou ouvrez un fichier .binary, .brdf ou .glsl.

## bench/settings

bench-scale-of-the-values = Échelle des valeurs
bench-scale = Échelle
bench-angle-along-the-horizontal-axis = Angle porté sur l'axe horizontal
bench-over = Abscisse
bench-angle-of-the-viewer-from-the = Angle de l'observateur avec la normale
bench-angle-between-light-and-viewer = Angle entre la lumière et l'observateur
bench-angle-of-incidence-between-light-and = Angle d'incidence, entre la lumière et la normale
bench-incidence = Incidence
bench-azimuth-of-the-light-from-the = Azimut de la lumière par rapport à la tangente, pour les fonctions anisotropes
bench-azimuth = Azimut
bench-plot-f-cos-angle-of-incidence = Tracer f cos(angle d'incidence), la radiance réfléchie pour une lumière d'irradiance 1 perpendiculairement à ses rayons
bench-times-cosine = fois le cosinus

## bench/toolbar

bench-back-to-the-scene = Revenir à la scène
bench-brdf-bench = Banc de BRDF
bench-add-a-model = Ajouter un modèle
bench-models-of-reflection-and-transmission = Modèles de réflexion et de transmission
bench-open-binary-merl-brdf-or-glsl = Ouvrir des fichiers .binary (MERL), .brdf ou .glsl, ou des ajustements en .toml (Ctrl + O) ; vous pouvez aussi les déposer ici
bench-save-the-plot = Enregistrer le graphique
bench-light-or-dark-theme = Thème clair ou sombre

## stations/controls

bench-parameters = Paramètres
bench-stop-the-film = Arrêter l'animation
bench-play-a-film-of-this-parameter = Lancer une animation de ce paramètre

## stations/law

bench-the-law-of = La loi de « { $title } »
bench-checks-of-the-law = Vérifications de la loi
bench-computed-after-the-picture-s-beginning = calculées après le début de l'image
bench-law-found = loi { $expected }   trouvé { $measured }   ± { $bound } { $unit }

## stations/mod

bench-the-stations-cannot-be-loaded = Les stations ne peuvent pas être chargées.
bench-loading-the-stations = Chargement des stations...
bench-the-link-names-an-unknown-station = le lien désigne une station inconnue `{ $name }`
bench-the-link-is-damaged = le lien est endommagé : { $error }
bench-copy-a-link-to-this-station = Copier un lien vers cette station
bench-beyond-the-rendering-equation = Au-delà de l'équation de rendu
bench-station-page = page de la station
bench-stations = Stations
bench-sliders = Curseurs
bench-text = Texte
bench-law = Loi

## stations/page

bench-the-rendering-equation-assumes = L'équation de rendu suppose
bench-in-nature = Dans la nature
bench-look = À observer
bench-question = Question
bench-the-law = La loi
bench-source = Source : { $source }

## stations/picture

bench-continue-to-refine-the-picture = Continuer d'affiner l'image
bench-stop-refining-the-picture = Arrêter d'affiner l'image
bench-1-sample = 1 échantillon
bench-samples-done = { $samples } échantillons, terminé
bench-samples-2 = { $samples } échantillons
bench-samples-of-each-pixel = Échantillons par pixel

## short words

bench-holds = vérifiée
bench-fails = non vérifiée
bench-pass = réussi
bench-fail = échec
bench-charts-word = îlots
bench-checker-word = damier
