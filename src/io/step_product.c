// What makes shapes of a STEP file products, by AP214 or AP203 (ISO 10303-203:1994, configuration
// controlled design), which also wants to know who made them, when, approved by whom and how secret
// they are. The date is no date, so that the same plant makes the same file.
#include "io/step_faces.h"

#include <string.h>

static const char units[] =
    "#5=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"
    "#6=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
    "#7=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n"
    "#8=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#5,'distance_accuracy_value','');\n"
    "#9=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#8))"
    "GLOBAL_UNIT_ASSIGNED_CONTEXT((#5,#6,#7))REPRESENTATION_CONTEXT('',''));\n";
static const char head[] = "ISO-10303-21;\nHEADER;\n"
                           "FILE_DESCRIPTION(('plants as rational B-spline surfaces'),'2;1');\n"
                           "FILE_NAME('','2000-01-01T00:00:00',(''),(''),'Frond " FR_VERSION
                           "','Frond " FR_VERSION "','');\n";
static const char head_214[] =
    "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
    "#1=APPLICATION_CONTEXT('automotive design');\n"
    "#2=APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#1);\n"
    "#3=PRODUCT_CONTEXT('',#1,'mechanical');\n"
    "#4=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');\n";
static const char head_203[] =
    "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));\nENDSEC;\nDATA;\n"
    "#1=APPLICATION_CONTEXT('configuration controlled 3D designs of mechanical parts and "
    "assemblies');\n"
    "#2=APPLICATION_PROTOCOL_DEFINITION('international standard','config_control_design',1994,"
    "#1);\n"
    "#3=MECHANICAL_CONTEXT('',#1,'mechanical');\n"
    "#4=DESIGN_CONTEXT('',#1,'design');\n";
static const char people_203[] =
    "#10=PERSON('','','',$,$,$);\n"
    "#11=ORGANIZATION('','','');\n"
    "#12=PERSON_AND_ORGANIZATION(#10,#11);\n"
    "#13=CALENDAR_DATE(2000,1,1);\n"
    "#14=COORDINATED_UNIVERSAL_TIME_OFFSET(0,0,.AHEAD.);\n"
    "#15=LOCAL_TIME(0,0,0.,#14);\n"
    "#16=DATE_AND_TIME(#13,#15);\n"
    "#17=APPROVAL_STATUS('not_yet_approved');\n"
    "#18=APPROVAL(#17,'');\n"
    "#19=APPROVAL_ROLE('approver');\n"
    "#20=APPROVAL_PERSON_ORGANIZATION(#12,#18,#19);\n"
    "#21=APPROVAL_DATE_TIME(#16,#18);\n"
    "#22=SECURITY_CLASSIFICATION_LEVEL('unclassified');\n"
    "#23=SECURITY_CLASSIFICATION('','',#22);\n"
    "#24=PERSON_AND_ORGANIZATION_ROLE('creator');\n"
    "#25=PERSON_AND_ORGANIZATION_ROLE('design_owner');\n"
    "#26=PERSON_AND_ORGANIZATION_ROLE('design_supplier');\n"
    "#27=PERSON_AND_ORGANIZATION_ROLE('classification_officer');\n"
    "#28=DATE_TIME_ROLE('creation_date');\n"
    "#29=DATE_TIME_ROLE('classification_date');\n"
    "#30=CC_DESIGN_PERSON_AND_ORGANIZATION_ASSIGNMENT(#12,#27,(#23));\n"
    "#31=CC_DESIGN_DATE_AND_TIME_ASSIGNMENT(#16,#29,(#23));\n";
enum { LAST_OF_UNITS = 9, LAST_OF_PEOPLE = 31 };

void fr_step_head(FrStep *step) {
    fr_step_text(step, head);
    fr_step_text(step, step->is_203 ? head_203 : head_214);
    fr_step_text(step, units);
    step->last = LAST_OF_UNITS;
    if (step->is_203) {
        fr_step_text(step, people_203);
        step->last = LAST_OF_PEOPLE;
    }
}

/// Quotes a name as ISO 10303-21 wants it: printable ASCII, quotes doubled.
static char *quoted(const char *name) {
    GString *text = g_string_new("'");
    for (const char *c = name; *c != '\0'; c++) {
        g_string_append_c(text, g_ascii_isprint(*c) && *c != '\\' ? *c : '_');
        if (*c == '\'') {
            g_string_append_c(text, '\'');
        }
    }
    g_string_append_c(text, '\'');
    return g_string_free(text, FALSE);
}

uint64_t fr_step_entity(FrStep *step, const char *kind, const char *before,
                        const uint64_t *references, size_t count, const char *after) {
    uint64_t entity = fr_step_begin(step);
    fr_step_text(step, kind);
    fr_step_text(step, before);
    for (size_t i = 0; i < count; i++) {
        fr_step_text(step, i > 0 ? "," : "");
        fr_step_reference(step, references[i]);
    }
    fr_step_text(step, after);
    return entity;
}

static void put_management(FrStep *step, uint64_t product, uint64_t formation,
                           uint64_t definition) {
    const uint64_t both[] = {formation, definition};
    fr_step_entity(step, "CC_DESIGN_PERSON_AND_ORGANIZATION_ASSIGNMENT(#12,#24,(", "", both, 2,
                   "));\n");
    fr_step_entity(step, "CC_DESIGN_PERSON_AND_ORGANIZATION_ASSIGNMENT(#12,#25,(", "", &product, 1,
                   "));\n");
    fr_step_entity(step, "CC_DESIGN_PERSON_AND_ORGANIZATION_ASSIGNMENT(#12,#26,(", "", &formation,
                   1, "));\n");
    fr_step_entity(step, "CC_DESIGN_DATE_AND_TIME_ASSIGNMENT(#16,#28,(", "", &definition, 1,
                   "));\n");
    fr_step_entity(step, "CC_DESIGN_APPROVAL(#18,(#23,", "", both, 2, "));\n");
    fr_step_entity(step, "CC_DESIGN_SECURITY_CLASSIFICATION(#23,(", "", &formation, 1, "));\n");
}

void fr_step_product(FrStep *step, const char *name, uint64_t representation) {
    char *text = quoted(name);
    uint64_t product = fr_step_begin(step);
    fr_step_text(step, "PRODUCT(");
    fr_step_text(step, text);
    fr_step_text(step, ",");
    fr_step_text(step, text);
    fr_step_text(step, ",'',(#3));\n");
    g_free(text);
    fr_step_entity(step, "PRODUCT_RELATED_PRODUCT_CATEGORY",
                   step->is_203 ? "('detail',$,(" : "('part',$,(", &product, 1, "));\n");
    uint64_t formation =
        step->is_203
            ? fr_step_entity(step, "PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE", "('','',",
                             &product, 1, ",.NOT_KNOWN.);\n")
            : fr_step_entity(step, "PRODUCT_DEFINITION_FORMATION", "('','',", &product, 1, ");\n");
    uint64_t definition =
        fr_step_entity(step, "PRODUCT_DEFINITION", "('design','',", &formation, 1, ",#4);\n");
    uint64_t shape =
        fr_step_entity(step, "PRODUCT_DEFINITION_SHAPE", "('','',", &definition, 1, ");\n");
    const uint64_t both[2] = {shape, representation};
    fr_step_entity(step, "SHAPE_DEFINITION_REPRESENTATION", "(", both, 2, ");\n");
    if (step->is_203) {
        put_management(step, product, formation, definition);
    }
}
