# The panel of the environment, and the gallery.

## app/environment

environment-the-scene-has-no-environment-choose = la scène n'a pas d'environnement : choisissez-en un d'abord
environment-saved-and-five-more-files = enregistré : { $first } et cinq autres fichiers
environment-saved = enregistré : { $first }
environment-the-environment-is-repaired = l'environnement est réparé

## environment/conversion

environment-the-environment-was-converted-already = l'environnement est déjà converti

## environment/mod

environment-the-study-of-the-environment-ended = L'examen de l'environnement s'est arrêté trop tôt.
environment-the-conversion-of-the-environment-ended = la conversion de l'environnement s'est arrêtée trop tôt
environment-the-environment-could-not-be-repaired = l'environnement n'a pas pu être réparé

## environment/panel

environment-openexr-linear-light-with-half-floats = OpenEXR : lumière linéaire en demi-flottants
environment-radiance-linear-light-with-a-shared = Radiance : lumière linéaire avec un exposant commun
environment-displayed-colours-with-the-exposure-and = Couleurs affichées, avec l'exposition et le mappage des tons de l'image
environment-as-fine-as-the-environment = aussi fin que l'environnement
environment-no-detail-is-lost = Aucun détail n'est perdu
environment-faces-of-128-x-128-a = Faces de 128 x 128, panorama de 512 x 256
environment-faces-of-256-x-256-a = Faces de 256 x 256, panorama de 1024 x 512
environment-faces-of-512-x-512-a = Faces de 512 x 512, panorama de 2048 x 1024
environment-faces-of-1024-x-1024-a = Faces de 1024 x 1024, panorama de 4096 x 2048
environment-faces-of-2048-x-2048-a = Faces de 2048 x 2048, panorama de 8192 x 4096
environment-as-texture-samplercube-direction-expects-an = Comme l'attend texture(samplerCube, direction) ; un lecteur d'images montre les faces en miroir
environment-the-faces-look-right-in-an = Les faces sont à l'endroit dans un lecteur d'images
environment-environment = Environnement
environment-close-the-environment-panel = Fermer le panneau de l'environnement
environment-open-a-panorama-a-cross-a = Ouvrir un panorama, une croix, une bande, une cubemap KTX2 ou DDS, ou six faces ; vous pouvez aussi les déposer ici
environment-the-scene-has-no-environment-choose-2 = La scène n'a pas d'environnement. Choisissez-en un ci-dessus, ou déposez un panorama ou six faces sur la fenêtre.
environment-reading-the-environment = Lecture de l'environnement...
environment-this-repaired-environment-only-exists-in = Cet environnement réparé n'existe que dans la fenêtre : enregistrez-le pour le garder.
environment-convert-and-save = Convertir et enregistrer
environment-built-in = Intégré
environment-panorama = Panorama
environment-horizontal-cross = Croix horizontale
environment-vertical-cross = Croix verticale
environment-horizontal-strip = Bande horizontale
environment-vertical-strip = Bande verticale
environment-cubemap-in-one-file = Cubemap en un fichier
environment-six-files = Six fichiers
environment-came-as-2 = Fourni en
environment-the-arrangement-of-the-environment-in = La disposition de l'environnement dans ses fichiers
environment-came-as = fourni en
environment-form = Forme
environment-size-of-the-faces-or-of = Taille des faces ou du panorama, et disposition dans laquelle les faces sont lues
environment-orientation = Orientation
environment-puts-every-face-in-its-place = Remet chaque face à sa place ; aucun texel ne change. L'opération peut être annulée.
environment-repair = Réparer
environment-format = Format
environment-the-format-of-pictures-ktx2-has = Le format des images ; KTX2 a le sien
environment-format-of-pictures = format des images
environment-size = Taille
environment-texels-along-an-edge-of-a = Texels le long d'une arête de face ; un panorama est quatre fois plus large
environment-layout = Disposition
environment-the-layout-of-the-faces-in = La disposition des faces dans les fichiers
environment-layout-of-faces = disposition des faces
environment-a-png-holds-displayed-colours-light = Un PNG contient des couleurs affichées : la lumière au-delà de 1 est perdue.
environment-converting-the-environment = Conversion de l'environnement...
environment-posx-to-negz-six-pictures-in = posx à negz, six images dans un fichier zip
environment-the-unfolded-cube-in-one-picture = Le cube déplié en une image, 4 faces sur 3
environment-one-picture-twice-as-wide-as = Une image, deux fois plus large que haute
environment-a-cubemap-with-its-mip-levels = Une cubemap avec ses niveaux de mipmaps, dans la disposition d'OpenGL
environment-six-pictures-sky-exr-is-saved = Six images : sky.exr est enregistré en sky_posx.exr à sky_negz.exr

## environment/pictures

environment-environment-face = face de l'environnement
environment-environment-panorama = panorama de l'environnement
environment-face-x-to-the-right = Face +X, à droite
environment-face-x-to-the-left = Face -X, à gauche
environment-face-y-above = Face +Y, au-dessus
environment-face-y-below = Face -Y, en dessous
environment-face-z-behind = Face +Z, derrière
environment-face-z-straight-ahead = Face -Z, droit devant
environment-panorama-360-degrees-from-left-to = Panorama : 360 degrés de gauche à droite, droit devant au milieu

## environment/product

environment-six-faces-zip = Six faces (ZIP)
environment-six-faces = Six faces
environment-cross = Croix
environment-strip = Bande

## environment/study

environment-the-environment-was-studied-already = l'environnement est déjà examiné

## gallery/mod

environment-the-light-equation = L'équation d'éclairage
environment-back-to-the-scene = Retour à la scène
environment-gallery = Galerie
environment-light-or-dark-theme-t = Thème clair ou sombre (T)

## gallery/thumbnails

environment-the-scene-could-not-be-loaded = la scène { $name } n'a pas pu être chargée
environment-the-scene-is-not-in-the = la scène { $name } n'est pas dans la galerie

## panels/messages

environment-show-line-of-the-file = Montrer la ligne { $line } du fichier

## panels/picture

environment-faces-and-conversion = Faces et conversion
environment-the-environment-as-six-faces-and = L'environnement en six faces et en panorama, la vérification de son orientation et sa conversion
