//! Sources that the documentation and the comments name by key, such as `[Wilkie2014]`.
//!
//! * `[Abasi2020]` S. Abasi et al., Distance metrics for very large color differences, Color Res. Appl. 45, 2020.
//! * `[Abebe2017]` M. A. Abebe et al., Perceptual lightness modeling for high-dynamic-range imaging, ACM TAP 15(1), 2017.
//! * `[ACES]` Academy of Motion Picture Arts and Sciences, S-2013-001 ACESproxy, S-2014-003 ACEScc, S-2014-004 ACEScg,
//!   S-2016-001 ACEScct; SMPTE ST 2065-1.
//! * `[AdobeRGB1998]` Adobe Systems, Adobe RGB (1998) color image encoding, 2005.
//! * `[Andersson2020]` P. Andersson et al., FLIP: a difference evaluator for alternating images, Proc. ACM CGIT 3(2), 2020.
//! * `[Apple2023]` Apple, Apple Log profile, 2023.
//! * `[ARRI2017]` ARRI, ALEXA Log C curve, usage in VFX, 2017.
//! * `[ARRI2022]` S. Cooper and H. Brendel, ARRI LogC4 logarithmic color space specification, 2022.
//! * `[ASTMD1535]` ASTM D1535-08e1, Standard practice for specifying color by the Munsell system, 2008.
//! * `[ASTMD1925]` ASTM D1925, Test method for yellowness index of plastics, 1970, withdrawn 1995.
//! * `[ASTME313]` ASTM E313-15, Standard practice for calculating yellowness and whiteness indices, 2015.
//! * `[Barr1981]` A. H. Barr, Superquadrics and angle-preserving transformations, IEEE CG&A 1(1), 1981.
//! * `[Bianco2010]` S. Bianco and R. Schettini, Two new von Kries based chromatic adaptation transforms found by numerical
//!   optimization, Color Res. Appl. 35, 2010.
//! * `[Blackmagic2021]` Blackmagic Design, Blackmagic Generation 5 color science; DaVinci wide gamut intermediate, 2021.
//! * `[BornWolf1999]` M. Born and E. Wolf, Principles of Optics, 7th edition, 1999.
//! * `[Brill2008]` M. H. Brill and S. Süsstrunk, Repairing gamut problems in CIECAM02, Color Res. Appl. 33, 2008.
//! * `[BT1886]` ITU-R BT.1886, Reference electro-optical transfer function for flat panel displays, 2011.
//! * `[BT2020]` ITU-R BT.2020-2, Parameter values for ultra-high definition television systems, 2015.
//! * `[BT2100]` ITU-R BT.2100-2, Image parameter values for high dynamic range television, 2018.
//! * `[BT2124]` ITU-R BT.2124-0, Objective metric for the potential visibility of colour differences in television, 2019.
//! * `[BT601]` ITU-R BT.601-7, Studio encoding parameters of digital television, 2011.
//! * `[BT709]` ITU-R BT.709-6, Parameter values for the HDTV standards, 2015.
//! * `[Burley2020]` B. Burley, Practical hash-based Owen scrambling, JCGT 9(4), 2020.
//! * `[Burns2019]` S. A. Burns, Numerical methods for smoothest reflectance reconstruction, Color Res. Appl. 45, 2019.
//! * `[Canon2020]` Canon, Canon Log gamma curves, version 1.2, 2020.
//! * `[CIE109]` CIE 109-1994, A method of predicting corresponding colours under different chromatic and illuminance
//!   adaptations.
//! * `[CIE116]` CIE 116-1995, Industrial colour-difference evaluation.
//! * `[CIE13.3]` CIE 13.3:1995, Method of measuring and specifying colour rendering properties of light sources.
//! * `[CIE15]` CIE 015:2018, Colorimetry, 4th edition.
//! * `[CIE159]` CIE 159:2004, A colour appearance model for colour management systems: CIECAM02.
//! * `[CIE167]` CIE 167:2005, Recommended practice for tabulating spectral data for use in colour computations.
//! * `[CIE170-2]` CIE 170-2:2015, Fundamental chromaticity diagram with physiological axes, part 2.
//! * `[CIE224]` CIE 224:2017, CIE 2017 colour fidelity index for accurate scientific use.
//! * `[CIE248]` CIE 248:2022, The CIE 2016 colour appearance model for colour management systems: CIECAM16.
//! * `[Clarke1984]` F. J. J. Clarke et al., Modification to the JPC79 colour-difference formula, JSDC 100, 1984.
//! * `[CSS4]` W3C, CSS Color Module Level 4, section 13.2, gamut mapping.
//! * `[Cui2002]` G. Cui et al., Uniform colour spaces based on the DIN99 colour-difference formula, Color Res. Appl. 27, 2002.
//! * `[Davis2010]` W. Davis and Y. Ohno, Color quality scale, Opt. Eng. 49, 2010.
//! * `[DCI2012]` Digital Cinema Initiatives, Digital cinema system specification 1.2, 2012; SMPTE RP 431-2.
//! * `[DIN6176]` DIN 6176, Colorimetric determination of colour differences of object colours by the DIN99 formula, 2001.
//! * `[DJI2017]` DJI, White paper on D-Log and D-Gamut, 2017.
//! * `[DLMF]` NIST Digital Library of Mathematical Functions, chapter 8, release 1.2, 2024.
//! * `[Duff2017]` T. Duff et al., Building an orthonormal basis, revisited, JCGT 6(1), 2017.
//! * `[DupuyBenyoub2023]` J. Dupuy and A. Benyoub, Sampling visible GGX normals with spherical caps, CGF 42(8), 2023.
//! * `[E2022]` ASTM E2022, Standard practice for calculation of weighting factors for tristimulus integration, 2016.
//! * `[E308]` ASTM E308, Standard practice for computing the colors of objects by using the CIE system, 2015.
//! * `[Ebner1998]` F. Ebner and M. D. Fairchild, Development and testing of a color space (IPT), CIC 6, 1998.
//! * `[ECI2007]` European Color Initiative, ECI RGB v2, 2007.
//! * `[Fairchild1991]` M. D. Fairchild, Formulation and testing of an incomplete-chromatic-adaptation model, Color Res.
//!   Appl. 16, 1991.
//! * `[Fairchild2010]` M. D. Fairchild and D. R. Wyble, hdr-CIELAB and hdr-IPT, CIC 18, 2010.
//! * `[Fairchild2011]` M. D. Fairchild and P. Chen, Brightness, lightness, and specifying color in high-dynamic-range scenes
//!   and images, SPIE 7867, 2011.
//! * `[Fairchild2013]` M. D. Fairchild, Color Appearance Models, 3rd edition, 2013.
//! * `[Fairchild2020]` M. D. Fairchild, Von Kries 2020: evolution of degree of chromatic adaptation, CIC 28, 2020.
//! * `[Fichet2021]` A. Fichet, R. Pacanowski, A. Wilkie, An OpenEXR layout for spectral images, JCGT 10(3), 2021.
//! * `[FilmLight2018]` FilmLight, T-Log and E-Gamut, 2018.
//! * `[Froehlich2017]` J. Fröhlich, Encoding high dynamic range and wide color gamut imagery, PhD thesis, Stuttgart, 2017.
//! * `[Fujifilm2022]` Fujifilm, F-Log data sheet 1.1 and F-Log2 data sheet 1.0, 2022.
//! * `[Ganz1979]` E. Ganz, Whiteness formulas: a selection, Appl. Opt. 18, 1979.
//! * `[Glasser1958]` L. G. Glasser et al., Cube-root color coordinate system, J. Opt. Soc. Am. 48, 1958.
//! * `[GoPro2016]` GoPro, Protune, 2016.
//! * `[H273]` ITU-T H.273, Coding-independent code points for video signal type identification, 2021.
//! * `[HachisukaJensen2009]` T. Hachisuka and H. W. Jensen, Stochastic progressive photon mapping, ACM TOG 28(5), 2009.
//! * `[Haines2019]` E. Haines et al., Precision improvements for ray/sphere intersection, Ray Tracing Gems 7, 2019.
//! * `[Harris1978]` F. J. Harris, On the use of windows for harmonic analysis with the DFT, Proc. IEEE 66(1), 1978.
//! * `[Heitz2014]` E. Heitz, Understanding the masking-shadowing function in microfacet-based BRDFs, JCGT 3(2), 2014.
//! * `[Heitz2019]` E. Heitz, A low-distortion map between triangle and square, 2019.
//! * `[Hellwig2020]` L. Hellwig and M. D. Fairchild, Using Gaussian spectra to derive a hue-linear color space, J. Percept.
//!   Imaging 3, 2020.
//! * `[Hellwig2022]` L. Hellwig and M. D. Fairchild, Brightness, lightness, colorfulness, and chroma in CIECAM02 and
//!   CAM16, Color Res. Appl. 47, 2022.
//! * `[Hellwig2022a]` L. Hellwig et al., Extending CIECAM02 and CAM16 for the Helmholtz–Kohlrausch effect, Color Res.
//!   Appl. 47, 2022.
//! * `[Hernandez1999]` J. Hernández-Andrés et al., Calculating correlated color temperatures across the entire gamut of
//!   daylight and skylight chromaticities, Appl. Opt. 38, 1999.
//! * `[Higham2002]` N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, 2002.
//! * `[HunterLab2008]` HunterLab, Hunter L, a, b color scale; illuminant factors, 2008.
//! * `[Hyndman1996]` R. J. Hyndman and Y. Fan, Sample quantiles in statistical packages, Am. Stat. 50(4), 1996.
//! * `[IEC61966]` IEC 61966-2-1, Default RGB colour space – sRGB, 1999.
//! * `[ISO7944]` ISO 7944, Optics and optical instruments – Reference wavelengths, 1998.
//! * `[Ize2013]` T. Ize, Robust BVH ray traversal, JCGT 2(2), 2013.
//! * `[Jakob2019]` W. Jakob and J. Hanika, A low-dimensional function space for efficient spectral upsampling, CGF 38(2), 2019.
//! * `[JoeKuo2008]` S. Joe and F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J.
//!   Sci. Comput. 30(5), 2008.
//! * `[Kang2002]` B. Kang et al., Design of advanced color temperature control system for HDTV applications, J. Korean
//!   Phys. Soc. 41, 2002.
//! * `[Kirk2019]` R. A. Kirk, Chromaticity coordinates for graphic arts based on CIE 2006 LMS with even spacing of Munsell
//!   colours, CIC 27, 2019.
//! * `[KnausZwicker2011]` C. Knaus and M. Zwicker, Progressive photon mapping: a probabilistic approach, ACM TOG 30(3), 2011.
//! * `[Kodak1995]` Kodak, Conversion of 10-bit log film data to 8-bit linear or video data, Cineon, 1995.
//! * `[Konovalenko2021]` I. A. Konovalenko et al., ProLab: a perceptually uniform projective color coordinate system, IEEE
//!   Access 9, 2021.
//! * `[Krystek1985]` M. Krystek, An algorithm to calculate correlated colour temperature, Color Res. Appl. 10, 1985.
//! * `[LaineKarras2011]` S. Laine and T. Karras, Stratified sampling for stochastic transparency, CGF 30(4), 2011.
//! * `[Lam1985]` K. M. Lam, Metamerism and colour constancy, PhD thesis, Bradford, 1985.
//! * `[Leica2022]` Leica, L-Log reference manual 1.6, 2022.
//! * `[Li2002]` C. Li et al., CMC 2000 chromatic adaptation transform: CMCCAT2000, Color Res. Appl. 27, 2002.
//! * `[Li2017]` C. Li et al., Comprehensive color solutions: CAM16, CAT16, and CAM16-UCS, Color Res. Appl. 42, 2017.
//! * `[Li2024]` M. Li and M. R. Luo, Simple color appearance model based on simple uniform color space, Opt. Express 32, 2024.
//! * `[Li2025]` M. Li, One step CAT16 chromatic adaptation transform, colour-science pull request 1349, 2025.
//! * `[Lindbloom2017]` B. J. Lindbloom, RGB working space information, 2017.
//! * `[Luo1998]` M. R. Luo and R. W. G. Hunt, A chromatic adaptation transform and a colour inconstancy index, Color Res.
//!   Appl. 23, 1998.
//! * `[Luo2006]` M. R. Luo et al., Uniform colour spaces based on CIECAM02, Color Res. Appl. 31, 2006.
//! * `[MacAdam1935]` D. L. MacAdam, Maximum visual efficiency of colored materials, J. Opt. Soc. Am. 25, 1935.
//! * `[MacAdam1974]` D. L. MacAdam, Uniform color scales, J. Opt. Soc. Am. 64, 1974.
//! * `[Mallett2019]` I. Mallett and C. Yuksel, Spectral primary decomposition for rendering with sRGB reflectance, EGSR, 2019.
//! * `[McCamy1992]` C. S. McCamy, Correlated color temperature as an explicit function of chromaticity coordinates, Color
//!   Res. Appl. 17, 1992.
//! * `[Meng2015]` J. Meng et al., Physically meaningful rendering using tristimulus colours, CGF 34(4), 2015.
//! * `[Mitchell1990]` D. P. Mitchell, Robust ray intersection with interval arithmetic, Graphics Interface, 1990.
//! * `[Moore2009]` R. E. Moore et al., Introduction to Interval Analysis, 2009.
//! * `[Moroney2002]` N. Moroney et al., The CIECAM02 color appearance model, CIC 10, 2002.
//! * `[Newhall1943]` S. M. Newhall et al., Final report of the OSA subcommittee on the spacing of the Munsell colors, J. Opt.
//!   Soc. Am. 33, 1943.
//! * `[Nikon2018]` Nikon, N-Log specification document 1.0, 2018.
//! * `[Ohno2005]` Y. Ohno, Spectral design considerations for white LED color rendering, Opt. Eng. 44, 2005.
//! * `[Ohno2014]` Y. Ohno, Practical use and calculation of CCT and Duv, LEUKOS 10(1), 2014.
//! * `[Otsu2018]` H. Otsu et al., Reproducing spectral reflectances from tristimulus colours, CGF 37(6), 2018.
//! * `[Ottosson2020]` B. Ottosson, A perceptual color space for image processing, 2020.
//! * `[Panasonic2014]` Panasonic, VARICAM V-Log and V-Gamut, 2014.
//! * `[PBRT4]` M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, 4th edition, 2023.
//! * `[Planck1901]` M. Planck, Über das Gesetz der Energieverteilung im Normalspectrum, Ann. Phys. 309, 1901.
//! * `[Polyanskiy2024]` M. N. Polyanskiy, Refractiveindex.info database of optical constants, Sci. Data 11, 2024.
//! * `[PrestonThomas1990]` H. Preston-Thomas, The International Temperature Scale of 1990, Metrologia 27, 1990.
//! * `[Quilez2013]` I. Quilez, Smooth minimum, 2013.
//! * `[Ragoo2021]` L. Ragoo and I. Farup, Optimising a Euclidean colour space transform for colour order and perceptual
//!   uniformity, CIC 29, 2021.
//! * `[RED2017]` RED Digital Cinema, White paper on REDWideGamutRGB and Log3G10, 2017.
//! * `[Reinhard2002]` E. Reinhard et al., Photographic tone reproduction for digital images, SIGGRAPH, 2002.
//! * `[Robertson1968]` A. R. Robertson, Computation of correlated color temperature and distribution temperature, J. Opt.
//!   Soc. Am. 58, 1968.
//! * `[Rodrigues1840]` O. Rodrigues, Des lois géométriques qui régissent les déplacements d'un système solide, 1840.
//! * `[Rousselle2011]` F. Rousselle, C. Knaus, M. Zwicker, Adaptive sampling and reconstruction using greedy error
//!   minimization, ACM TOG 30(6), 2011.
//! * `[Safdar2017]` M. Safdar et al., Perceptually uniform color space for image signals, Opt. Express 25, 2017.
//! * `[Safdar2021]` M. Safdar et al., ZCAM, a colour appearance model based on a high dynamic range uniform colour
//!   space, Opt. Express 29, 2021.
//! * `[Schoen1970]` A. H. Schoen, Infinite periodic minimal surfaces without self-intersections, NASA TN D-5541, 1970.
//! * `[Schroedinger1920]` E. Schrödinger, Theorie der Pigmente von größter Leuchtkraft, Ann. Phys. 367, 1920.
//! * `[Sharma2005]` G. Sharma et al., The CIEDE2000 color-difference formula: implementation notes, supplementary test data,
//!   and mathematical observations, Color Res. Appl. 30, 2005.
//! * `[ShirleyChiu1997]` P. Shirley and K. Chiu, A low distortion map between disk and square, JGT 2(3), 1997.
//! * `[SI2019]` BIPM, The International System of Units, 9th edition, 2019.
//! * `[Smits1999]` B. Smits, An RGB-to-spectrum conversion for reflectances, JGT 4(4), 1999.
//! * `[SMPTE240M]` SMPTE 240M, 1125-line high-definition production systems, signal parameters, 1999.
//! * `[Sony2016]` Sony, S-Log white paper 2012; Technical summary for S-Gamut3.Cine/S-Log3 and S-Gamut3/S-Log3, 2016.
//! * `[Spaulding2000]` K. E. Spaulding et al., Reference input/output medium metric RGB color encodings, PICS, 2000.
//! * `[SSI2020]` Academy of Motion Picture Arts and Sciences, Academy spectral similarity index: overview, 2020; SMPTE
//!   ST 2122.
//! * `[ST2084]` SMPTE ST 2084, High dynamic range electro-optical transfer function of mastering reference displays, 2014.
//! * `[Steele2014]` G. L. Steele et al., Fast splittable pseudorandom number generators, OOPSLA, 2014.
//! * `[Susstrunk2000]` S. Süsstrunk et al., Chromatic adaptation performance of different RGB sensors, SPIE 4300, 2000.
//! * `[TM27]` ANSI/IES TM-27, IES standard format for the electronic transfer of spectral data, 2020.
//! * `[TM30]` ANSI/IES TM-30-18, IES method for evaluating light source color rendition, 2018.
//! * `[Tolkowsky1919]` M. Tolkowsky, Diamond Design, 1919.
//! * `[Turk1994]` G. Turk, The PLY polygon file format, 1994.
//! * `[Veach1997]` E. Veach, Robust Monte Carlo methods for light transport simulation, PhD thesis, Stanford, 1997.
//! * `[Vegdahl2021]` N. Vegdahl, Building a better LK hash, 2021.
//! * `[Vose1991]` M. D. Vose, A linear algorithm for generating random numbers with a given distribution, IEEE TSE 17(9), 1991.
//! * `[Wald2007]` I. Wald, On fast construction of SAH-based bounding volume hierarchies, IEEE RT, 2007.
//! * `[Wald2008]` I. Wald et al., Getting rid of packets, IEEE RT, 2008.
//! * `[Walter2007]` B. Walter et al., Microfacet models for refraction through rough surfaces, EGSR, 2007.
//! * `[Wavefront1995]` Wavefront Technologies, Advanced Visualizer Manual, appendix B1, object files, 1995.
//! * `[Wendland1995]` H. Wendland, Piecewise polynomial, positive definite and compactly supported radial functions, 1995.
//! * `[Wilkie2014]` A. Wilkie et al., Hero wavelength spectral sampling, CGF 33(4), 2014.
//! * `[Woop2013]` S. Woop, C. Benthin, I. Wald, Watertight ray/triangle intersection, JCGT 2(1), 2013.
//! * `[Wyszecki1963]` G. Wyszecki, Proposal for a new color-difference formula, J. Opt. Soc. Am. 53, 1963.
//! * `[Wyszecki2000]` G. Wyszecki and W. S. Stiles, Color Science, 2nd edition, 2000.
//! * `[Ylitie2017]` H. Ylitie et al., Efficient incoherent ray traversal on GPUs through compressed wide BVHs, HPG, 2017.
//! * `[Zhai2018]` Q. Zhai and M. R. Luo, Study of chromatic adaptation via neutral white matches, Opt. Express 26,
//!   2018.
