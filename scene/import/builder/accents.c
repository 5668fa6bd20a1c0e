// SPDX-License-Identifier: MIT
// The letters that are another letter with a mark, such as an accent, as the canonical decompositions of Unicode have
// them, and the syllables of Korean, which are computed (The Unicode Standard, 3.12). Letters beyond the first 65,536,
// signs of mathematics, and letters that Unicode never composes, such as those of Hebrew with points and of Bengali
// with a nukta, stay as they are.
#include "accents.h"

#include <stdlib.h>
#include <string.h>

// Bytes that one byte of a name may become: a syllable of 3 is 9, and a letter of 2 has 3 accents.
enum { LONGEST = 12 };

// Letters without the accent, each followed by itself with it. Of two letters that are the same, the first is made of
// parts.
static const struct {
    uint32_t mark;
    const char *pairs;
} accents[] = {
    {0x300, // grave
     "AÀEÈIÌOÒUÙaàeèiìoòuùÜǛüǜNǸnǹЕЀИЍеѐиѝĒḔēḕŌṐōṑ"
     "WẀwẁÂẦâầĂẰăằÊỀêềÔỒôồƠỜơờƯỪưừYỲyỳἀἂἁἃἈἊἉἋἐἒἑἓἘἚἙἛἠἢἡἣἨἪἩἫ"
     "ἰἲἱἳἸἺἹἻὀὂὁὃὈὊὉὋὐὒὑὓὙὛὠὢὡὣὨὪὩὫαὰεὲηὴιὶοὸυὺωὼΑᾺΕῈΗῊ᾿῍ϊῒΙῚ"
     "῾῝ϋῢΥῪ¨῭ΟῸΩῺ"},
    {0x301, // acute
     "AÁEÉIÍOÓUÚYÝaáeéiíoóuúyýCĆcćLĹlĺNŃnńRŔrŕSŚsś"
     "ZŹzźÜǗüǘGǴgǵÅǺåǻÆǼæǽØǾøǿΑΆΕΈΗΉΙΊΟΌΥΎΩΏϊΐαάεέ"
     "ηήιίϋΰοόυύωώГЃКЌгѓкќÇḈçḉĒḖēḗÏḮïḯKḰkḱMḾmḿÕṌõṍ"
     "ŌṒōṓPṔpṕŨṸũṹWẂwẃÂẤâấĂẮăắÊẾêếÔỐôốƠỚơớƯỨưứ¨΅ϒϓἀἄἁἅἈἌἉἍἐἔἑἕ"
     "ἘἜἙἝἠἤἡἥἨἬἩἭἰἴἱἵἸἼἹἽὀὄὁὅὈὌὉὍὐὔὑὕὙὝὠὤὡὥὨὬὩὭ᾿῎῾῞αάεέηήιίοό"
     "υύωώΑΆΕΈϊΐΙΊϋΰΥΎΟΌΩΏ"},
    {0x302, // circumflex
     "AÂEÊIÎOÔUÛaâeêiîoôuûCĈcĉGĜgĝHĤhĥJĴjĵSŜsŝWŴwŵ"
     "YŶyŷZẐzẑẠẬạậẸỆẹệỌỘọộ"},
    {0x303, // tilde
     "AÃNÑOÕaãnñoõIĨiĩUŨuũVṼvṽÂẪâẫĂẴăẵEẼeẽÊỄêễÔỖôỗ"
     "ƠỠơỡƯỮưữYỸyỹ"},
    {0x304, // macron
     "AĀaāEĒeēIĪiīOŌoōUŪuūÜǕüǖÄǞäǟȦǠȧǡÆǢæǣǪǬǫǭÖȪöȫ"
     "ÕȬõȭȮȰȯȱYȲyȳИӢиӣУӮуӯGḠgḡḶḸḷḹṚṜṛṝαᾱΑᾹιῑΙῙυῡΥῩ"},
    {0x306, // breve
     "AĂaăEĔeĕGĞgğIĬiĭOŎoŏUŬuŭУЎИЙийуўЖӁжӂАӐаӑЕӖеӗ"
     "ȨḜȩḝẠẶạặαᾰΑᾸιῐΙῘυῠΥῨ"},
    {0x307, // dot above
     "CĊcċEĖeėGĠgġIİZŻzżAȦaȧOȮoȯBḂbḃDḊdḋFḞfḟHḢhḣMṀ"
     "mṁNṄnṅPṖpṗRṘrṙSṠsṡŚṤśṥŠṦšṧṢṨṣṩTṪtṫWẆwẇXẊxẋYẎ"
     "yẏſẛ"},
    {0x308, // diaeresis
     "AÄEËIÏOÖUÜaäeëiïoöuüyÿYŸΙΪΥΫιϊυϋЕЁІЇеёіїАӒаӓ"
     "ӘӚәӛЖӜжӝЗӞзӟИӤиӥОӦоӧӨӪөӫЭӬэӭУӰуӱЧӴчӵЫӸыӹHḦhḧ"
     "ÕṎõṏŪṺūṻWẄwẅXẌxẍtẗϒϔ"},
    {0x309, // hook above
     "AẢaảÂẨâẩĂẲăẳEẺeẻÊỂêểIỈiỉOỎoỏÔỔôổƠỞơởUỦuủƯỬưử"
     "YỶyỷ"},
    {0x30a, // ring above
     "AÅaåUŮuůwẘyẙ"},
    {0x30b, // double acute
     "OŐoőUŰuűУӲуӳ"},
    {0x30c, // caron
     "CČcčDĎdďEĚeěLĽlľNŇnňRŘrřSŠsšTŤtťZŽzžAǍaǎIǏiǐ"
     "OǑoǒUǓuǔÜǙüǚGǦgǧKǨkǩƷǮʒǯjǰHȞhȟ"},
    {0x31b, // horn
     "OƠoơUƯuư"},
    {0x323, // dot below
     "BḄbḅDḌdḍHḤhḥKḲkḳLḶlḷMṂmṃNṆnṇRṚrṛSṢsṣTṬtṭVṾvṿ"
     "WẈwẉZẒzẓAẠaạEẸeẹIỊiịOỌoọƠỢơợUỤuụƯỰưựYỴyỵ"},
    {0x326, // comma below
     "SȘsșTȚtț"},
    {0x327, // cedilla
     "CÇcçGĢgģKĶkķLĻlļNŅnņRŖrŗSŞsşTŢtţEȨeȩDḐdḑHḨhḩ"},
    {0x328, // ogonek
     "AĄaąEĘeęIĮiįUŲuųOǪoǫ"},
    {0x30f, // double grave
     "AȀaȁEȄeȅIȈiȉOȌoȍRȐrȑUȔuȕѴѶѵѷ"},
    {0x311, // inverted breve
     "AȂaȃEȆeȇIȊiȋOȎoȏRȒrȓUȖuȗ"},
    {0x313, // smooth breathing
     "αἀΑἈεἐΕἘηἠΗἨιἰΙἸοὀΟὈυὐωὠΩὨρῤ"},
    {0x314, // rough breathing
     "αἁΑἉεἑΕἙηἡΗἩιἱΙἹοὁΟὉυὑΥὙωὡΩὩρῥΡῬ"},
    {0x324, // diaeresis below
     "UṲuṳ"},
    {0x325, // ring below
     "AḀaḁ"},
    {0x32d, // circumflex below
     "DḒdḓEḘeḙLḼlḽNṊnṋTṰtṱUṶuṷ"},
    {0x32e, // breve below
     "HḪhḫ"},
    {0x330, // tilde below
     "EḚeḛIḬiḭUṴuṵ"},
    {0x331, // macron below
     "BḆbḇDḎdḏKḴkḵLḺlḻNṈnṉRṞrṟTṮtṯZẔzẕhẖ"},
    {0x342, // Greek circumflex
     "ἀἆἁἇἈἎἉἏἠἦἡἧἨἮἩἯἰἶἱἷἸἾἹἿὐὖὑὗὙὟὠὦὡὧὨὮὩὯαᾶ¨῁ηῆ᾿῏ιῖϊῗ῾῟υῦϋῧωῶ"},
    {0x345, // iota below
     "ἀᾀἁᾁἂᾂἃᾃἄᾄἅᾅἆᾆἇᾇἈᾈἉᾉἊᾊἋᾋἌᾌἍᾍἎᾎἏᾏἠᾐἡᾑἢᾒἣᾓἤᾔἥᾕἦᾖἧᾗἨᾘἩᾙἪᾚἫᾛ"
     "ἬᾜἭᾝἮᾞἯᾟὠᾠὡᾡὢᾢὣᾣὤᾤὥᾥὦᾦὧᾧὨᾨὩᾩὪᾪὫᾫὬᾬὭᾭὮᾮὯᾯὰᾲαᾳάᾴᾶᾷΑᾼὴῂηῃήῄ"
     "ῆῇΗῌὼῲωῳώῴῶῷΩῼ"},
    {0x653, // madda
     "اآ"},
    {0x654, // hamza
     "اأوؤيئەۀہۂےۓ"},
    {0x655, // hamza below
     "اإ"},
    {0x93c, // nukta
     "नऩरऱळऴ"},
    {0x9be, "েো"}, // Bengali
    {0x9d7, "েৌ"},
    {0xb3e, "େୋ"}, // Oriya
    {0xb56, "େୈ"},
    {0xb57, "େୌ"},
    {0xbbe, "ெொேோ"}, // Tamil
    {0xbd7, "ஒஔெௌ"},
    {0xc56, "ెై"},  // Telugu
    {0xcc2, "ೆೊ"}, // Kannada
    {0xcd5, "ಿೀೆೇೊೋ"},
    {0xcd6, "ೆೈ"},
    {0xd3e, "െൊേോ"}, // Malayalam
    {0xd57, "െൌ"},
    {0xdca, "ෙේොෝ"}, // Sinhala
    {0xdcf, "ෙො"},
    {0xddf, "ෙෞ"},
    {0x102e, "ဥဦ"},                  // Burmese
    {0x1b35, "ᬅᬆᬇᬈᬉᬊᬋᬌᬍᬎᬑᬒᬺᬻᬼᬽᬾᭀᬿᭁᭂᭃ"}, // Balinese
    {0x3099,                         // dakuten
     "かがきぎくぐけげこごさざしじすずせぜそぞただちぢつづてでとどはばひびふぶへべほぼうゔゝゞ"
     "カガキギクグケゲコゴサザシジスズセゼソゾタダチヂツヅテデトドハバヒビフブヘベホボウヴワヷ"
     "ヰヸヱヹヲヺヽヾ"},
    {0x309a, // handakuten
     "はぱひぴふぷへぺほぽハパヒピフプヘペホポ"},
};

// Syllables of Korean: 19 first consonants, 21 vowels, and 27 last consonants or none, in this order.
enum { SYLLABLES = 0xac00, FIRSTS = 0x1100, VOWELS = 0x1161, LASTS = 0x11a7 };
enum { FIRST_COUNT = 19, VOWEL_COUNT = 21, LAST_COUNT = 28 };
enum { SYLLABLE_COUNT = FIRST_COUNT * VOWEL_COUNT * LAST_COUNT };

// Return the code point at the cursor, and go on behind it. Return 0 at the end, and for what is not UTF-8.
static uint32_t take(const char **cursor)
{
    const unsigned char *const c = (const unsigned char *)*cursor;
    int more = c[0] < 0x80 ? 0 : -1;
    for (int i = 1; i < 4 && more < 0; i++) {
        static const unsigned char least[] = {0, 0xc2, 0xe0, 0xf0, 0xf5};
        more = c[0] >= least[i] && c[0] < least[i + 1] ? i : -1;
    }
    uint32_t point = more <= 0 ? c[0] : c[0] & (0x3fu >> more);
    for (int i = 1; i <= more; i++) {
        if ((c[i] & 0xc0) != 0x80) {
            return 0;
        }
        point = point << 6 | (c[i] & 0x3fu);
    }
    *cursor += more < 0 ? 0 : more + (c[0] != 0);
    return more < 0 ? 0 : point;
}

static char *put(char *out, uint32_t point)
{
    const int more = point < 0x80 ? 0 : point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
    static const unsigned char starts[] = {0, 0xc0, 0xe0, 0xf0};
    *out++ = (char)(starts[more] | point >> (6 * more));
    for (int i = more - 1; i >= 0; i--) {
        *out++ = (char)(0x80 | ((point >> (6 * i)) & 0x3f));
    }
    return out;
}

// Return a letter with an accent. Return 0 if there is none.
static uint32_t join(uint32_t letter, uint32_t mark)
{
    if (letter >= FIRSTS && letter < FIRSTS + FIRST_COUNT && mark >= VOWELS && mark < VOWELS + VOWEL_COUNT) {
        return SYLLABLES + ((letter - FIRSTS) * VOWEL_COUNT + mark - VOWELS) * LAST_COUNT;
    }
    const bool is_open =
        letter >= SYLLABLES && letter < SYLLABLES + SYLLABLE_COUNT && (letter - SYLLABLES) % LAST_COUNT == 0;
    if (is_open && mark > LASTS && mark < LASTS + LAST_COUNT) {
        return letter + mark - LASTS;
    }
    for (size_t i = 0; i < sizeof accents / sizeof accents[0]; i++) {
        const char *pair = accents[i].pairs;
        while (accents[i].mark == mark && *pair != 0) {
            const uint32_t plain = take(&pair), whole = take(&pair);
            if (plain == letter) {
                return whole;
            }
        }
    }
    return 0;
}

// Write a code point without its accents, and these behind it.
static char *part(char *out, uint32_t point)
{
    if (point >= SYLLABLES && point < SYLLABLES + SYLLABLE_COUNT) {
        const uint32_t number = point - SYLLABLES;
        out = put(out, FIRSTS + number / LAST_COUNT / VOWEL_COUNT);
        out = put(out, VOWELS + number / LAST_COUNT % VOWEL_COUNT);
        return number % LAST_COUNT == 0 ? out : put(out, LASTS + number % LAST_COUNT);
    }
    uint32_t marks[4];
    int count = 0;
    for (size_t i = 0; i < sizeof accents / sizeof accents[0] && count < 4; i++) {
        for (const char *pair = accents[i].pairs; *pair != 0;) {
            const uint32_t plain = take(&pair);
            if (take(&pair) == point) {
                marks[count++] = accents[i].mark;
                point = plain;
                i = (size_t)-1; // from the first accent on
                break;
            }
        }
    }
    out = put(out, point);
    while (count > 0) {
        out = put(out, marks[--count]);
    }
    return out;
}

char *scene_accents_part(struct scene_import *import, const char *name)
{
    char *const parted = scene_import_allocate(import, LONGEST * strlen(name) + 1, 1), *out = parted;
    while (*name != 0) {
        const uint32_t point = take(&name);
        if (point == 0) {
            free(parted);
            return NULL;
        }
        out = part(out, point);
    }
    *out = 0;
    return parted;
}

char *scene_accents_join(struct scene_import *import, const char *name)
{
    char *const joined = scene_import_allocate(import, LONGEST * strlen(name) + 1, 1), *out = joined;
    uint32_t letter = 0;
    while (*name != 0) {
        const uint32_t point = take(&name), whole = letter == 0 ? 0 : join(letter, point);
        if (point == 0) {
            free(joined);
            return NULL;
        }
        if (whole == 0 && letter != 0) {
            out = put(out, letter);
        }
        letter = whole == 0 ? point : whole;
    }
    *(letter == 0 ? out : put(out, letter)) = 0;
    return joined;
}
