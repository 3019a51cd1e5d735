"""Materials that several scenes share."""

from . import pictures, textures
from .materials import glass, matte, metal, picture, textured

GLASS = glass()
OAK = textured("oak", textures.wood((150, 108, 68), (212, 172, 124)), 0.9, 0.45)
WALNUT = textured("walnut", textures.wood((70, 44, 28), (122, 82, 54), 4), 0.9, 0.45)
DARK_WOOD = matte("dark wood", 0.12, 0.06, 0.035)
BOARDS = textured("floor boards", textures.planks((122, 88, 58), (206, 166, 124)), 2.4, 1.2)
PLASTER = matte("plaster", 0.8, 0.78, 0.73)
CEILING = textured("ceiling boards", textures.speckle((190, 188, 182), (232, 230, 224)), 0.6, 0.6)
WHITE = matte("white lacquer", 0.8, 0.8, 0.78)
GREY = matte("grey plastic", 0.3, 0.31, 0.32)
BLACK = matte("black plastic", 0.035, 0.035, 0.04)
STEEL = metal("steel", 0.75, 0.75, 0.77, roughness=0.35)
BRASS = metal("brass", 0.8, 0.58, 0.28, roughness=0.3)
TERRACOTTA = matte("terracotta", 0.62, 0.2, 0.1)
TEAL = matte("teal", 0.1, 0.38, 0.42)
CREAM = matte("cream", 0.78, 0.7, 0.54)
SOIL = matte("soil", 0.05, 0.035, 0.025)
STEM = matte("stem", 0.16, 0.24, 0.06)
LEAVES = (
    matte("leaf", 0.09, 0.3, 0.06),
    matte("young leaf", 0.2, 0.42, 0.09),
    matte("old leaf", 0.06, 0.2, 0.07),
)
EVENING = picture("evening", pictures.dusk())
LANDSCAPE = picture("landscape", pictures.landscape())
ABSTRACT = picture("discs", pictures.abstract(21))
PAGES = picture("page", pictures.printed_page(3))
LETTER = picture("letter", pictures.printed_page(4))
